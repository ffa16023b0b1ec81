"""Labels of points that do not cover lines, points or each other.

Boxes are rows x0, y0, x1, y1 in pixels.
"""

import math
from collections import namedtuple

import numpy as np

DISTANCES = (6, 11, 18, 27, 38, 52, 70, 95)  # points from the marker to the label's edge
DIRECTIONS = (-135, 45, -90, 180, -45, 135, 0, 90)  # degrees: a front has room below it
TIED_FROM = 12  # points: labels farther away are tied to their marker by a thin line

# Where a label may stand: its box, the boxes along its tie (none if it is near), and where on it the tie ends.
Place = namedtuple("Place", "box tie relative")


def place_labels(axes, labels, lines, **text):
    """Writes each label beside its point, at the nearest free place inside the axes. If no place is free, the label may
    cover lines, but never another label: then it is left out.

    labels: (x, y, words) in data coordinates; earlier ones choose first. lines: the drawn lines, each a list of the
    (x, y) of its markers. text: keywords of annotate().
    """
    renderer = axes.figure.canvas.get_renderer()
    scale = axes.figure.dpi / 72.0
    inside = axes.get_window_extent(renderer).extents
    pixels = axes.transData.transform
    drawn = np.concatenate([np.zeros((0, 4)), *(_boxes_along(pixels(line), scale) for line in lines if line)])
    written = np.zeros((0, 4))
    for x, y, words in labels:
        at = pixels((x, y))
        note = axes.annotate(words, (x, y), **text)
        extent = note.get_window_extent(renderer)
        note.remove()
        size = np.array([extent.width, extent.height])
        places = [_place(at, size, distance, angle, scale) for distance in DISTANCES for angle in DIRECTIONS]
        fitting = [place for place in places if _within(place.box, inside) and not _hits(place, written)]
        if not fitting:
            continue
        around = drawn[~((drawn[:, :2] <= at).all(1) & (at <= drawn[:, 2:]).all(1))]
        chosen = min(fitting, key=lambda place: _hits(place, around))  # the first of equals is the nearest
        written = np.concatenate([written, chosen.box[None] + scale * np.array([-1, -1, 1, 1]), chosen.tie])
        axes.annotate(words, (x, y), xytext=(chosen.box[:2] - at) / scale, textcoords="offset points", ha="left",
                      va="bottom", **text,
                      arrowprops={"arrowstyle": "-", "lw": 0.4, "color": "#7a828c", "shrinkA": 0, "shrinkB": 2,
                                  "relpos": chosen.relative} if len(chosen.tie) else None)


def _box(middle, half):
    """Boxes around middles (n x 2)."""
    middle = np.atleast_2d(middle)
    return np.concatenate([middle - half, middle + half], axis=1)


def _boxes_along(line, scale):
    """Small boxes that cover the line and, larger ones, its markers."""
    boxes = [_box(line, 3 * scale)]
    for one, other in zip(line[:-1], line[1:], strict=True):
        count = int(np.hypot(*(other - one)) / (3 * scale))
        boxes.append(_box(one + np.linspace(0, 1, count + 2)[1:-1, None] * (other - one), scale))
    return np.concatenate(boxes)


def _place(at, size, distance, angle, scale):
    """The Place whose nearest edge is `distance` (points) from the marker in this direction (degrees)."""
    away = np.array([math.cos(math.radians(angle)), math.sin(math.radians(angle))])
    side = np.where(np.abs(away) < 0.1, 0.0, np.sign(away))
    edge = at + away * distance * scale
    tie = _boxes_along(np.array([at, edge]), scale)[2:] if distance > TIED_FROM else np.zeros((0, 4))
    return Place(_box(edge + side * size / 2, size / 2)[0], tie, tuple((1 - side) / 2))


def _hits(place, boxes):
    """How many of the boxes the label and its tie cover."""
    mine = np.concatenate([place.box[None], place.tie])[:, None]
    return int(((mine[..., :2] < boxes[:, 2:]) & (boxes[:, :2] < mine[..., 2:])).all(2).sum())


def _within(box, outer):
    return (box[:2] >= outer[:2]).all() and (box[2:] <= outer[2:]).all()
