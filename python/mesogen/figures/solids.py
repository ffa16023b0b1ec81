"""Solids: where no particles are."""

import numpy as np

from ..grid import sample

FILL, OUTLINE = "#d9dbdf", "#4a4f58"


def draw(axes, scene):
    """Covers the solids of a map, with their outline. Nothing where particles fill the box."""
    coverage = scene.deposit.coverage
    if coverage.min() > 0.5:
        return
    grid = scene.grid
    # One cell more on each side, so that the outline ends at the faces of the box.
    x, y = (np.concatenate([[c[0] - d], c, [c[-1] + d]]) for c, d in zip((grid.x, grid.y), grid.cell))
    for axis in (0, 1):
        sides = [(1, 1) if a == 1 - axis else (0, 0) for a in (0, 1)]
        coverage = np.pad(coverage, sides, mode="wrap" if grid.periodic[axis] else "edge")
    axes.contourf(x, y, coverage, levels=[-1.0, 0.5], colors=[FILL], zorder=3)
    axes.contour(x, y, coverage, levels=[0.5], colors=[OUTLINE], linewidths=0.9, zorder=3)


def in_fluid(scene, place):
    """Which places, rows of x and y, lie in the fluid."""
    return sample(scene.deposit.coverage, scene.grid, place) > 0.5
