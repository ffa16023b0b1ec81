"""Error against cost: one line per variant, and the Pareto front."""

from ..analysis import by_variant, front
from . import look
from .labels import place_labels

FRONT = "#22262b"


def draw(title, subtitle, points):
    """The page. points: of all variants, with failed ones; at least one has an error above 0."""
    page, axes = look.chart(title, subtitle, lines=len(by_variant(points)) + 2)
    shown = [p for p in points if not p.failed and p.error > 0]
    failed = [p for p in points if p.failed]
    best = front(shown)
    axes.plot([p.wall for p in best], [100 * p.error for p in best], color=FRONT, lw=5.0, alpha=0.16, zorder=1,
              solid_capstyle="round", solid_joinstyle="round", label="Pareto front")
    look.log_axis(axes.xaxis, [p.wall for p in shown + failed], room=(0.25, 0.12))
    look.log_axis(axes.yaxis, [100 * p.error for p in shown], room=(0.2, 0.12))
    top = axes.get_ylim()[1]
    lines = []
    for number, (variant, group) in enumerate(by_variant(points).items()):
        style = look.look_of(number)
        line = [p for p in group if p in shown]
        lines.append(line)
        axes.plot([p.wall for p in line], [100 * p.error for p in line], label=variant, zorder=3, **style)
        axes.plot([p.wall for p in group if p.failed], [top] * sum(p.failed for p in group), "x", color=style["color"],
                  ms=6, mew=1.6, clip_on=False, zorder=4)
    if failed:
        axes.plot([], [], "x", color=FRONT, ms=6, mew=1.6, label="failed after that time")
    axes.set_xlabel("wall time (s)")
    axes.set_ylabel("error (%)")
    look.legend(axes)
    place_labels(axes, [(p.wall, 100 * p.error, p.name) for p in best],
                 [[(p.wall, 100 * p.error) for p in line] for line in [best, *lines]], fontsize=7.0, color=FRONT, zorder=5)
    return page
