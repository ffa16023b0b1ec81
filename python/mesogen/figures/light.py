"""The edges of the light: where an activity that varies, and is stored, is half way between its least and its most."""

COLOUR = "#e0a100"


def draw(axes, scene):
    """Dashed lines on a map. Nothing where the activity is the same everywhere, or not stored."""
    if not scene.has("activity"):
        return
    activity = scene.activity
    low, high = float(activity.min()), float(activity.max())
    if not high - low > 1e-6 * max(abs(low), abs(high)):
        return
    x, y, activity = scene.grid.to_the_faces(activity)
    axes.contour(x, y, activity, levels=[0.5 * (low + high)], colors=[COLOUR], linewidths=1.4, linestyles="dashed",
                 zorder=2.5)
