"""What all charts share: colours for colour-blind readers too, logarithmic axes with readable ticks, and saving."""

import math
import os

import matplotlib
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator
from matplotlib.transforms import ScaledTranslation

from ...figures import style

# Okabe and Ito's palette, without its yellow, which is lost on white; markers tell apart what colours cannot.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
MARKERS = ("o", "s", "^", "D", "v", "P", "X", "<", ">", "*", "h")
LINES = ("-", (0, (5, 2)), (0, (1.5, 1.5)))
GRID = "#e6e8eb"
LEGEND_LINE = 0.178  # inches

SETTINGS = {
    **style.SETTINGS,
    "svg.hashsalt": "mesogen",
    "svg.fonttype": "path",
    "legend.fontsize": 8.0,
    "axes.axisbelow": True,
}


def settings():
    """Context in which charts are made and saved."""
    return matplotlib.rc_context(SETTINGS)


def look_of(number):
    """Colour, marker and line of the n-th variant, as keywords of plot(); 77 of them differ."""
    return {"color": COLOURS[number % len(COLOURS)], "marker": MARKERS[number % len(MARKERS)],
            "linestyle": LINES[number // len(COLOURS) % len(LINES)], "markersize": 4.5, "markeredgewidth": 0.0}


def chart(title, subtitle="", lines=0, width=7.6, height=4.4, legend=2.3):
    """(page, axes) of a chart, with room on the right for a legend of `lines` lines. Sizes are in inches."""
    height = max(height, 1.1 + LEGEND_LINE * lines)
    page = style.page(width, height)
    left, bottom, top = 0.75, 0.55, 0.55
    axes = page.add_axes([left / width, bottom / height, (width - left - legend) / width, (height - bottom - top) / height])
    page.text(left / width, 1 - 0.22 / height, title, fontsize=10.5, va="center")
    page.text(left / width, 1 - 0.41 / height, subtitle, fontsize=8.0, color=style.QUIET, va="center")
    axes.spines[["top", "right"]].set_visible(False)
    return page, axes


def legend(axes, **more):
    """The legend on the right of the axes. more: keywords of legend()."""
    axes.legend(loc="upper left", bbox_to_anchor=(1.03, 1.0), borderaxespad=0.0, handlelength=2.4, labelspacing=0.55,
                **more)


def log_ticks(low, high):
    """Positions of ticks from low to high: decades if there are four or more, else finer steps too."""
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    for steps in ((1,), (1, 2, 5), (1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9)):
        ticks = [m * 10.0**d for d in decades for m in steps if low <= m * 10.0**d <= high]
        if len(ticks) >= 4:
            break
    return ticks


def log_axis(axis, values, room=(0.12, 0.12), ticks=None):
    """A logarithmic axis over the values, with plain numbers at its ticks.

    axis: axes.xaxis or axes.yaxis; room: free space at either end, as shares of the range.
    """
    low, high = min(values), max(values)
    spread = max(math.log10(high / low), 0.3)
    low, high = low * 10 ** (-room[0] * spread), high * 10 ** (room[1] * spread)
    scale, limits = ((axis.axes.set_xscale, axis.axes.set_xlim) if axis.axis_name == "x" else
                     (axis.axes.set_yscale, axis.axes.set_ylim))
    scale("log")
    limits(low, high)
    axis.set_major_locator(FixedLocator(ticks or log_ticks(low, high)))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(FuncFormatter(lambda value, _: plain(value)))
    axis.grid(True, color=GRID, lw=0.6)


def plain(value):
    """A short text of a number: 12, 0.05, 3000, 2·10⁶."""
    if 1e-3 <= abs(value) < 1e4:
        return f"{value:g}"
    power = math.floor(math.log10(abs(value)))
    ten = "10" + str(power).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    factor = f"{value / 10**power:g}"
    return ten if factor == "1" else f"{factor}·{ten}"


def save(page, stem):
    """Writes stem.png and stem.svg, without dates or versions in them. Returns the names of the files."""
    names = [f"{stem}.png", f"{stem}.svg"]
    for name, metadata in zip(names, ({"Software": None}, {"Date": None, "Creator": None}), strict=True):
        page.savefig(name + ".tmp", format=name[-3:], metadata=metadata)
        os.replace(name + ".tmp", name)
    return names


def shifted(axes, points):
    """The data's transform, moved to the right by some points."""
    return axes.transData + ScaledTranslation(points / 72.0, 0.0, axes.figure.dpi_scale_trans)
