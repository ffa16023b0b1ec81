"""The director as short lines over the order q, with the defects."""

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import LinearSegmentedColormap

from .. import nematics
from ..grid import sample
from . import light, solids, style

# Dark at the cores, pale where the nematic is ordered, so that dark lines stand on it. Perceptually uniform: each
# colour sits where its lightness L* puts it.
ORDER_COLOURS = LinearSegmentedColormap.from_list(
    "order",
    [(0, "#0a1024"),
     (0.175, "#16335b"),
     (0.418, "#1f6f8b"),
     (0.685, "#63b4a8"),
     (0.884, "#c3e0c0"),
     (1, "#fbf7e4")],
)


def lacking(scene):
    return scene.lacks("order_tensor")


def draw(axes, scene, lines_across=46):
    """The map. lines_across: director lines along the longer side of the box."""
    q11, q12 = scene.order_tensor
    order = np.hypot(q11, q12)
    top = float(np.quantile(order[scene.deposit.interior], 0.999)) or 1.0
    image = axes.imshow(
        order, origin="lower", extent=scene.grid.extent, cmap=ORDER_COLOURS, vmin=0, vmax=top, interpolation="bicubic"
    )
    draw_lines(axes, scene, lines_across)
    light.draw(axes, scene)
    solids.draw(axes, scene)
    draw_defects(axes, scene, defect_size(scene.box, len(scene.defects)))
    style.box_axes(axes, scene.box, scene.run.length_unit)
    style.titles(axes, "Director and order", scene)
    style.colour_bar(axes, image, "order q")


def draw_lines(axes, scene, lines_across):
    step = max(scene.box) / lines_across
    counts = np.maximum(1, np.rint(scene.box / step)).astype(int)
    x, y = ((np.arange(n) + 0.5) * length / n for n, length in zip(counts, scene.box))
    place = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    place = place[solids.in_fluid(scene, place)]
    angle, order = nematics.director(*(sample(q, scene.grid, place) for q in scene.order_tensor))
    half = 0.41 * step * np.clip(order, 0.55, 1.0)
    along = np.stack([half * np.cos(angle), half * np.sin(angle)], axis=-1)
    # White on the dark cores, dark elsewhere: readable on any background.
    colours = np.where((order < 0.4)[:, None], (1, 1, 1, 0.85), (0.04, 0.09, 0.16, 0.9))
    width = 72 * 4.4 / lines_across * 0.13
    segments = np.stack([place - along, place + along], axis=1)
    axes.add_collection(LineCollection(segments, colors=colours, linewidths=width, capstyle="round"))


def defect_size(box, count):
    """Size of the symbol of a defect (m), the same for all in a picture: a share of the picture, smaller where defects
    stand so close in the mean, or the box is so narrow, that symbols would cover what is between them."""
    box = np.asarray(box, dtype=float)
    distance = np.sqrt(box.prod() / max(count, 1))
    return min(0.018 * box.max(), 0.06 * box.min(), 0.1 * distance)


def draw_defects(axes, scene, size):
    """+1/2 as a drop whose tail lies along the orientation, -1/2 as a star of three legs. size: of a core (m)."""
    defects = scene.defects
    for charge, outline, colour in ((1, _drop, style.PLUS), (-1, _star, style.MINUS)):
        shapes = [
            outline(size, *row[[0, 1, 3]]) + image
            for row in defects[np.sign(defects[:, 2]) == charge]
            for image in _images(row[:2], scene.box, scene.grid.periodic, 3 * size)
        ]
        axes.add_collection(
            PolyCollection(shapes, facecolors=colour, edgecolors="white", linewidths=0.7, joinstyle="round", zorder=4)
        )


def _images(place, box, periodic, margin):
    """Shifts that also show what reaches over a periodic face of the box."""
    shifts = []
    for x, length, goes_on in zip(place, box, periodic):
        near = [length] * bool(x < margin) + [-length] * bool(x > length - margin)
        shifts.append([0.0] + near * goes_on)
    return [np.array([dx, dy]) for dx in shifts[0] for dy in shifts[1]]


def _turned(radius, angle, x, y):
    return np.stack([x + radius * np.cos(angle), y + radius * np.sin(angle)], axis=1)


def _drop(size, x, y, orientation):
    """A round head that runs out into a point at 2.6 sizes: the circle and its two tangents from there."""
    reach = 2.6
    touch = np.arccos(1 / reach)
    around = np.linspace(touch, 2 * np.pi - touch, 40)
    radius = np.concatenate([np.ones(40), [reach]]) * size
    return _turned(radius, np.concatenate([around, [0.0]]) + orientation, x, y)


def _star(size, x, y, orientation):
    """Three rounded legs, 120 degrees apart."""
    around = np.linspace(0, 2 * np.pi, 120, endpoint=False)
    radius = size * (0.55 + 1.25 * (0.5 + 0.5 * np.cos(3 * around)) ** 2)
    return _turned(radius, around + orientation, x, y)


def figure(scene):
    page, (axes,) = style.tiles(1, 1, style.map_size(scene.box))
    draw(axes, scene)
    _draw_key(axes, scene)
    return page


def _draw_key(axes, scene):
    """How many defects of each charge, on the line of the x label."""
    charge = scene.defects[:, 2]
    for offset, colour, name, count in (
        (-52, style.PLUS, "+1/2", int((charge > 0).sum())),
        (0, style.MINUS, "−1/2", int((charge < 0).sum())),
    ):
        axes.annotate(
            f"● {name}: {count}", (1, 0), (offset, -28), xycoords="axes fraction", textcoords="offset points",
            color=colour, fontsize=8, ha="right", va="center",
        )
