"""Error against resolution: one line per variant, with its fitted order in the legend."""

import math

from ..analysis import by_variant, order
from . import look


def draw(title, subtitle, points):
    """The page. points: as for error_cost."""
    page, axes = look.chart(title, subtitle, lines=len(by_variant(points)) + 1)
    shown = [p for p in points if not p.failed and p.error > 0]
    resolutions = sorted({p.resolution for p in points})
    look.log_axis(axes.xaxis, resolutions, room=(0.05, 0.05), ticks=thinned(resolutions))
    look.log_axis(axes.yaxis, [100 * p.error for p in shown])
    top = axes.get_ylim()[1]
    for number, (variant, group) in enumerate(by_variant(points).items()):
        style = look.look_of(number)
        line = [p for p in group if p in shown]
        fitted = order(line)
        label = variant if math.isnan(fitted) else f"{variant}, order {fitted:.1f}"
        axes.plot([p.resolution for p in line], [100 * p.error for p in line], label=label, zorder=3, **style)
        axes.plot([p.resolution for p in group if p.failed], [top] * sum(p.failed for p in group), "x",
                  color=style["color"], ms=6, mew=1.6, clip_on=False, zorder=4)
    if any(p.failed for p in points):
        axes.plot([], [], "x", color="#22262b", ms=6, mew=1.6, label="failed")
    axes.set_xlabel("particles across")
    axes.set_ylabel("error (%)")
    look.legend(axes)
    return page


def thinned(resolutions, most=8):
    """Resolutions for ticks: at most `most`, at least 12 % apart."""
    ticks = []
    for one in resolutions:
        if not ticks or one >= 1.12 * ticks[-1]:
            ticks.append(one)
    return ticks[:: -(-len(ticks) // most)]
