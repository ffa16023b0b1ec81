"""Solids: where no particles are."""

from ..grid import sample

FILL, OUTLINE = "#d9dbdf", "#4a4f58"


def draw(axes, scene):
    """Covers the solids of a map, with their outline. Nothing where particles fill the box."""
    coverage = scene.deposit.coverage
    if coverage.min() > 0.5:
        return
    x, y, coverage = scene.grid.to_the_faces(coverage)
    axes.contourf(x, y, coverage, levels=[-1.0, 0.5], colors=[FILL], zorder=3)
    axes.contour(x, y, coverage, levels=[0.5], colors=[OUTLINE], linewidths=0.9, zorder=3)


def in_fluid(scene, place):
    """Which places, rows of x and y, lie in the fluid."""
    return sample(scene.deposit.coverage, scene.grid, place) > 0.5
