"""The map of where and how each variant fails: lines over a second parameter, or bars if there is none."""

import math

from ...figures import style
from . import look

# A marker for each way to fail; the colour tells the variant.
WAYS = {
    "NaN": "X", "ran away": "*", "compression": "P", "void": "p", "gathering": "h", "pair": "8", "too slow": "H",
    "stopped": "X", "clumping": "o", "volume": "s", "density": "D", "energy": "^", "momentum": "<", "order": ">", "error": "v",
}
HELD, FAILED, UNKNOWN = "#9ec9e2", "#f3c6a5", "#ececec"


def draw(study, searches):
    """The page. searches: the Found of each cell."""
    numbers = study.across_key and all(isinstance(value, (int, float)) for value in study.across_values)
    return _lines(study, searches) if numbers and len(study.across_values) > 1 else _bars(study, searches)


# ---- over a second parameter ------------------------------------------------------------------------------------------


def _lines(study, searches):
    page, axes = look.chart(study.title, "bars: where it holds; markers: where it fails, and how first")
    sweep = study.sweep
    _scale(axes.xaxis, study.across_values)
    _sweep_axis(axes.yaxis, sweep)
    for number, variant in enumerate(study.variants):
        colour = look.COLOURS[number % len(look.COLOURS)]
        line = look.LINES[number // len(look.COLOURS) % len(look.LINES)]
        mine = [found for found in searches if found.cell.variant == variant and found.rows]
        # Variants stand side by side.
        beside = {"transform": look.shifted(axes, (number - (len(study.variants) - 1) / 2) * 6.0), "color": colour}
        for upward in (True, False):
            edges = [(found.cell.across, [e for e in found.edges if (e[1] > e[0]) == upward]) for found in mine]
            axes.plot([x for x, there in edges if len(there) == 1],
                      [_middle(sweep, there[0]) for _, there in edges if len(there) == 1], ls=line, lw=1.0, zorder=2, **beside)
        for found in mine:
            x = found.cell.across
            for low, high, held in spans(sweep, found):
                if held:
                    axes.plot([x, x], [low, high], lw=3.5, alpha=0.3, solid_capstyle="butt", zorder=1, **beside)
            for edge in found.edges:
                axes.plot([x], [_middle(sweep, edge)], WAYS[edge[2]["how"]], ms=6.5, mew=0, zorder=3, **beside)
            if found.fails:
                axes.plot([x], [sweep.first], "x", ms=6, mew=1.6, clip_on=False, zorder=3, **beside)
        axes.plot([], [], color=colour, ls=line, label=variant.name)
    for way in dict.fromkeys(edge[2]["how"] for found in searches for edge in found.edges):
        axes.plot([], [], WAYS[way], color=style.INK, ms=6, mew=0, label=way)
    if any(found.rows and found.fails for found in searches):
        axes.plot([], [], "x", color=style.INK, ms=6, mew=1.6, label="fails over the whole range")
    axes.set_xlabel(study.across_name)
    axes.set_ylabel(study.sweep_name)
    look.legend(axes)
    return page


def _middle(sweep, edge):
    inside, outside, _ = edge
    return math.sqrt(inside * outside) if sweep.log else 0.5 * (inside + outside)


def _scale(axis, values):
    if min(values) > 0 and max(values) / min(values) >= 5:
        look.log_axis(axis, values, room=(0.08, 0.08), ticks=list(values))
    else:
        room = 0.08 * (max(values) - min(values))
        axis.axes.set_xlim(min(values) - room, max(values) + room)
        axis.set_ticks(list(values), [look.plain(value) for value in values])
        axis.grid(True, color=look.GRID, lw=0.6)


def _sweep_axis(axis, sweep):
    ends = sorted((sweep.first, sweep.last))
    if sweep.log:
        look.log_axis(axis, ends, room=(0.04, 0.04))
    else:
        room = 0.04 * (ends[1] - ends[0])
        (axis.axes.set_ylim if axis.axis_name == "y" else axis.axes.set_xlim)(ends[0] - room, ends[1] + room)
        axis.grid(True, color=look.GRID, lw=0.6)


# ---- bars ---------------------------------------------------------------------------------------------------------------


def _bars(study, searches):
    names = [found.cell.name for found in searches]
    width, row, head, foot = 7.6, 0.34, 0.62, 0.6
    height = head + foot + row * len(names)
    page = style.page(width, height)
    left = 0.35 + 0.075 * max(len(name) for name in names)
    axes = page.add_axes([left / width, foot / height, (width - left - 0.35) / width, row * len(names) / height])
    page.text(0.2 / width, 1 - 0.22 / height, study.title, fontsize=10.5, va="center")
    axes.spines[["top", "right", "left"]].set_visible(False)
    _sweep_axis(axes.xaxis, study.sweep)
    axes.set_ylim(len(names) - 0.5, -0.5)
    axes.set_yticks(range(len(names)), names)
    axes.tick_params(axis="y", length=0)
    for number, found in enumerate(searches):
        for low, high, held in spans(study.sweep, found):
            axes.barh(number, high - low, left=low, height=0.62, color={True: HELD, False: FAILED, None: UNKNOWN}[held],
                      zorder=2)
        _edges(axes, study.sweep, number, found.edges)
        if found.complete and not found.edges:
            words = "holds over the whole range" if found.holds else "fails over the whole range"
            ways = list(dict.fromkeys(row["how"] for row in found.rows.values() if row["how"]))
            axes.text(0.5, number, words + (f": {', '.join(ways)}" if ways else ""), transform=axes.get_yaxis_transform(),
                      ha="center", va="center", fontsize=7.5, zorder=4)
    axes.set_xlabel(study.sweep_name)
    for colour, words, x in ((HELD, "holds", 0.0), (FAILED, "fails", 0.12)):
        at = {"transform": axes.transAxes, "fontsize": 8.5, "va": "bottom"}
        axes.text(x, 1.0 + 0.1 / (row * len(names)), "■", color=colour, **at)
        axes.text(x + 0.025, 1.0 + 0.1 / (row * len(names)), words, **at)
    return page


def _edges(axes, sweep, number, edges):
    """The boundaries of one bar; if there is room, each has a text on the side where runs fail."""
    low, high = sorted((sweep.first, sweep.last))

    def share(value):
        return math.log(value / low) / math.log(high / low) if sweep.log else (value - low) / (high - low)

    middles = [_middle(sweep, edge) for edge in edges]
    taken = []
    for middle, (inside, outside, row) in zip(middles, edges, strict=True):
        axes.plot([middle, middle], [number - 0.31, number + 0.31], color=style.INK, lw=1.4, zorder=3)
        words = f"{row['how']} at {outside:g}"
        length = 0.014 * len(words)
        right = share(middle) + length < 1.0 if outside > inside else share(middle) < length
        span = (share(middle), share(middle) + length) if right else (share(middle) - length, share(middle))
        others = [(share(other), share(other)) for other in middles if other != middle]
        if any(span[0] < other[1] and other[0] < span[1] for other in taken + others):
            continue  # the table has this text too
        taken.append(span)
        axes.annotate(words, (middle, number), xytext=(6 if right else -6, 0), textcoords="offset points",
                      ha="left" if right else "right", va="center", fontsize=7.5, zorder=4)


def spans(sweep, found):
    """[(low, high, held)] that cover what has been tried; held is None between two values that were not narrowed."""
    values = sorted(found.rows)
    result = []
    for low, high in zip(values, values[1:]):
        one, other = (not found.rows[value]["how"] for value in (low, high))
        if one == other:
            result.append((low, high, one))
        else:
            middle = math.sqrt(low * high) if sweep.log else 0.5 * (low + high)
            result += [(low, middle, one), (middle, high, other)]
    return result
