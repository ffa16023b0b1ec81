"""Vorticity with streamlines."""

import numpy as np

from ..grid import Grid, sample
from . import light, solids, style

STREAM_CELLS = 96  # cells along the longer side are enough for streamlines, and keep them quick


def lacking(scene):
    return scene.lacks("velocity")


def draw(axes, scene, density=1.5):
    """The map. density: of streamlines, as matplotlib's streamplot takes it."""
    vorticity = scene.vorticity
    # A symmetric scale that a few extreme cells do not stretch.
    limit = float(np.quantile(np.abs(vorticity[scene.deposit.interior]), 0.998)) or 1.0
    image = axes.imshow(
        vorticity, origin="lower", extent=scene.grid.extent, cmap="RdBu_r", vmin=-limit, vmax=limit,
        interpolation="bicubic",
    )
    _draw_streamlines(axes, scene, density)
    light.draw(axes, scene)
    solids.draw(axes, scene)
    style.box_axes(axes, scene.box, scene.run.length_unit)
    style.titles(axes, "Vorticity and streamlines", scene)
    style.colour_bar(axes, image, style.labelled("vorticity", f"1/{scene.run.time_unit}"))


def _draw_streamlines(axes, scene, density):
    grid, (u, v) = _coarse(scene)
    speed = np.hypot(u, v)
    if not speed.max() > 0:
        return
    x, y, u, v, speed = grid.to_the_faces(u, v, speed)
    share = np.array(scene.box) / max(scene.box)
    axes.streamplot(
        x, y, u, v, density=density * share, color=(0.1, 0.12, 0.15, 0.8),
        linewidth=0.25 + 0.75 * np.sqrt(speed / speed.max()), arrowsize=0.55, minlength=0.08,
    )


def _coarse(scene):
    """The velocity on at most STREAM_CELLS cells along the longer side."""
    if max(scene.grid.shape) <= STREAM_CELLS:
        return scene.grid, scene.velocity
    cells = np.maximum(4, np.rint(STREAM_CELLS * scene.box / max(scene.box)))
    grid = Grid(scene.box, cells, scene.grid.periodic, scene.grid.length_unit)
    place = np.stack(np.meshgrid(grid.x, grid.y), axis=-1).reshape(-1, 2)
    return grid, [sample(component, scene.grid, place).reshape(grid.shape) for component in scene.velocity]


def figure(scene):
    page, (axes,) = style.tiles(1, 1, style.map_size(scene.box))
    draw(axes, scene)
    return page
