"""The edges of the light: where an activity that varies, and is stored, is half way between its least and its most."""

import numpy as np

COLOUR = "#e0a100"


def draw(axes, scene):
    """Dashed lines on a map. Nothing where the activity is the same everywhere, or not stored."""
    if not scene.has("activity"):
        return
    activity = scene.activity
    low, high = float(activity.min()), float(activity.max())
    if not high - low > 1e-6 * max(abs(low), abs(high)):
        return
    grid = scene.grid
    # One cell more on each side, so that lines end at the faces of the box.
    x, y = (np.concatenate([[c[0] - d], c, [c[-1] + d]]) for c, d in zip((grid.x, grid.y), grid.cell))
    for axis in (0, 1):
        sides = [(1, 1) if a == 1 - axis else (0, 0) for a in (0, 1)]
        activity = np.pad(activity, sides, mode="wrap" if grid.periodic[axis] else "edge")
    axes.contour(x, y, activity, levels=[0.5 * (low + high)], colors=[COLOUR], linewidths=1.4, linestyles="dashed",
                 zorder=2.5)
