"""Mixing: the colour carried by the particles, and the mixing index over time."""

import numpy as np
from matplotlib.colors import LinearSegmentedColormap

from . import solids, style

COLOURS = LinearSegmentedColormap.from_list("mixing", ["#f4f1e8", "#e9b872", "#c4553b", "#6d1a36"])


def _index(scene):
    return scene.run.observer_of("mixing_index")


def lacking(scene):
    if _index(scene) is None and not scene.has("colour"):
        return "neither field 'colour' nor a mixing index is stored (add [colour] and an observer of type \"mixing\")"
    return None


def has_map(scene):
    """Whether the colour field can be drawn."""
    return scene.has("colour")


def draw(axes, scene):
    """The map of the colour field."""
    grid, colour = scene.colour
    image = axes.imshow(
        colour, origin="lower", extent=grid.extent, cmap=COLOURS, vmin=0, vmax=1, interpolation="bicubic"
    )
    solids.draw(axes, scene)
    style.box_axes(axes, scene.box, scene.run.length_unit)
    style.titles(axes, "Mixing: colour of the initial quarter", scene)
    style.colour_bar(axes, image, "colour")


def draw_index(axes, scene):
    """The mixing index over the whole run, with a mark at the frame."""
    time, value = scene.run.series(_index(scene), "mixing_index")
    axes.plot(time, value, color=style.SERIES[1])
    if scene.time is not None:
        now = np.interp(scene.time, time, value)
        axes.plot(scene.time, now, "o", color=style.SERIES[1], ms=5, mec="white", clip_on=False)
    axes.set_xlim(time[0], max(time[-1], time[0] + 1e-12))
    axes.set_ylim(0, 1)
    axes.set_xlabel(scene.time_label)
    axes.set_ylabel("mixing index")
    axes.set_title("Mixing index")
    axes.spines[["top", "right"]].set_visible(False)


def figure(scene):
    drawers = [draw] if has_map(scene) else []
    drawers += [draw_index] if _index(scene) is not None else []
    page, axes = style.tiles(1, len(drawers), style.map_size(scene.box))
    for place, drawer in zip(axes, drawers):
        drawer(place, scene)
    return page
