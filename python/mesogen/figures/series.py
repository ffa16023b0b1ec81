"""Every recorded number over time, in small panels."""

from collections import namedtuple

import numpy as np

from . import style

NAMES = {
    "v_rms": "rms velocity",
    "vorticity_rms": "rms vorticity",
    "divergence_rms": "rms divergence",
    "total_momentum": "total momentum",
    "min_spacing": "smallest particle spacing",
    "mean_order": "mean order q",
    "minimum_order": "minimum order q",
}
# Shown together: (title, {quantity: name in the legend})
TOGETHER = (
    ("density", {"density_min": "min", "density_max": "max"}),
    ("particle volume V / V₀", {"volume_min": "min", "volume_max": "max"}),
    ("order q", {"mean_order": "mean", "minimum_order": "min"}),
    ("number of defects", {"count_plus": "+1/2", "count_minus": "−1/2"}),
)
COLUMNS = 3


# What one panel shows; lines: a list of (name in the legend, time, value).
Panel = namedtuple("Panel", "observer quantities title unit lines")


def panels(run):
    """Everything that is drawn, as a list of Panel.

    Scalars, and tables of one row (its columns are named x, y, z). Tables of many rows have other figures.
    """
    found = []
    for observer, quantities in run.observers.items():
        rest = list(quantities)
        for title, members in TOGETHER:
            if set(members) <= set(rest):
                lines = [line for quantity, name in members.items() for line in _lines(run, observer, quantity, name)]
                if lines:
                    unit = run.series_unit(observer, next(iter(members)))
                    found.append(Panel(observer, tuple(members), title, unit, lines))
                rest = [quantity for quantity in rest if quantity not in members]
        for quantity in rest:
            lines = _lines(run, observer, quantity, "")
            if lines:
                title = NAMES.get(quantity, quantity.replace("_", " "))
                found.append(Panel(observer, (quantity,), title, run.series_unit(observer, quantity), lines))
    return found


def _lines(run, observer, quantity, name):
    time, value = run.series(observer, quantity)
    if not len(time):
        return []
    if value.ndim == 1:
        return [(name, time, value)]
    if value.ndim == 3 and value.shape[1] == 1 and 1 < value.shape[2] <= 3:
        return [("xyz"[column], time, value[:, 0, column]) for column in range(value.shape[2])]
    return []


def _power(values):
    """The power of ten (a multiple of three) to take out of a panel's numbers, 0 if they are readable as they are."""
    largest = max(float(np.nanmax(np.abs(value), initial=0.0)) for value in values)
    if largest == 0 or 1e-2 <= largest < 1e4:
        return 0
    return int(3 * np.floor(np.log10(largest) / 3))


def _without_turns(angle):
    """Director angles, which jump by pi when they leave (-pi/2, pi/2]: a gap instead of the jump."""
    jump = np.abs(np.diff(angle, prepend=angle[0])) > np.pi / 2
    return np.where(jump, np.nan, angle)


def lacking(scene):
    return None if panels(scene.run) else "no observer recorded a number over time"


def draw_panel(axes, scene, panel):
    """One small panel, with a thin mark at the frame."""
    observer, _, title, unit, lines = panel
    power = _power([value for _, _, value in lines])
    for number, (name, time, value) in enumerate(lines):
        mark = "o" if len(time) == 1 else None
        # Dashed where it lies upon the line before it.
        dashed = number > 0 and np.array_equal(value, lines[number - 1][2])
        shown = _without_turns(value) if unit == "rad" else value
        axes.plot(
            time, shown / 10.0**power, color=style.SERIES[number], label=name, marker=mark, ms=3,
            ls=(0, (3, 3)) if dashed else "-",
        )
    if all(np.ptp(value) == 0 for _, _, value in lines):
        middle = lines[0][2][0] / 10.0**power
        axes.set_ylim(middle - 1, middle + 1)
    ends = [limit for _, time, _ in lines for limit in (time[0], time[-1])]
    axes.set_xlim(min(ends), max(max(ends), min(ends) + 1e-12))
    if scene.time is not None and scene.time < max(ends):
        axes.axvline(scene.time, color=style.QUIET, lw=0.6, ls=(0, (3, 3)), zorder=0)
    axes.margins(y=0.08)
    axes.set_title(style.labelled(title, unit, power), fontsize=8.5)
    axes.set_title(observer, loc="right", fontsize=7.5, color=style.QUIET)
    axes.locator_params(axis="both", nbins=5)
    axes.spines[["top", "right"]].set_visible(False)
    axes.grid(True, color="#e6e8eb", lw=0.5)
    axes.set_axisbelow(True)
    if len(lines) > 1:
        axes.legend(loc="best", ncol=len(lines), handlelength=1.2, columnspacing=1.0, borderaxespad=0.2)


def figure(scene):
    shown = panels(scene.run)
    columns = min(COLUMNS, len(shown))
    rows = -(-len(shown) // columns)
    page, axes = style.tiles(rows, columns, (2.45, 1.25), head=0.1, margins=(0.55, 0.2, 0.28, 0.4))
    for place, panel in zip(axes, shown):
        draw_panel(place, scene, panel)
    for unused in axes[len(shown) :]:
        unused.set_visible(False)
    for last in axes[max(0, len(shown) - columns) : len(shown)]:
        last.set_xlabel(scene.time_label)
    return page
