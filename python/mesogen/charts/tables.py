"""The tables of an accuracy study: Markdown for people, CSV for programs."""

import math
import textwrap

from ..runs.ledger import csv_text
from ..runs.markdown import head_lines, table_lines
from .analysis import LEVELS, by_variant, cheapest, front, order, reach


def points_csv(points):
    """The text of points.csv: one line per point."""
    columns = ("variant", "resolution", "error", "wall_seconds", "wall_seconds_min", "wall_seconds_max", "cpu_seconds",
               "steps", "peak_memory", "runs", "failure")
    return csv_text(columns, [(p.variant, p.resolution, p.error, p.wall, p.wall_low, p.wall_high, p.cpu, p.steps,
                               p.memory, p.runs, p.failure) for p in points])


def markdown(study, points, rows):
    """The text of table.md. rows: of runs.csv, those of the points, for machine, version and date."""
    return "\n".join([f"# {study.title}", "", *_head(study, rows), "", *_point_table(study, points), "",
                      *_failures(points), *_level_tables(points)]) + "\n"


def _head(study, rows):
    answer = study.scene.answer
    threads = f"{study.threads} thread{'s' if study.threads != 1 else ''}"
    return [*_wrapped(f"Scene: {answer.title}. {answer.source.strip()}"), "", *head_lines(rows), *_wrapped(
            f"With {threads}; medians of {study.repeats} run{'s' if study.repeats != 1 else ''}"
            + (f" for each of {len(study.seeds)} seeds" if study.seeds else "")
            + ". Error: root mean square of what the answer tells, relative. Wall time is that of stepping.")]


def _wrapped(text):
    return textwrap.wrap(text, 120, break_long_words=False, break_on_hyphens=False)


def percent(error):
    """A relative error with three digits: 1.23 %, 0.0456 %."""
    return f"{100 * error:.3g} %" if 1e-4 <= error < 10 else f"{100 * error:.2e} %"


def seconds(value):
    """A time with three digits; "" if it is NaN."""
    return "" if math.isnan(value) else f"{value:.3g}"


def _table(header, rows):
    return table_lines(header, rows, left=("variant", "note", "cheapest", "how"))


def _point_table(study, points):
    notes = {variant.name: variant.note for variant in study.variants}
    best = {point.name for point in front([p for p in points if not p.failed])}
    rows = []
    for variant, group in by_variant(points).items():
        for number, p in enumerate(group):
            note = ["FAILED"] if p.failed else ["front"] if p.name in best else []
            note += [notes[variant]] if number == 0 and notes.get(variant) else []
            rows.append((variant, str(p.resolution), "" if p.failed else percent(p.error), seconds(p.wall), seconds(p.cpu),
                         "" if p.failed else f"{p.steps:.0f}", "" if p.failed else f"{p.memory / 1e6:.0f}",
                         "; ".join(note)))
    return _table(["variant", "across", "error", "wall (s)", "CPU (s)", "steps", "memory (MB)", "note"], rows)


def _failures(points):
    lines = [f"- {p.name}: {p.failure}" for p in points if p.failed]
    return ["Failures:", "", *lines, ""] if lines else []


def _level_tables(points):
    rows = []
    for level in LEVELS:
        best = cheapest(points, level)
        if best is None:
            smallest = min((p for p in points if not p.failed), key=lambda p: p.error, default=None)
            how = f"the smallest error is {percent(smallest.error)}, {smallest.name}" if smallest else "nothing ran"
            rows.append((percent(level), "none", "", how))
        else:
            rows.append((percent(level), best.variant, seconds(best.wall), how_text(best)))
    text = ["The cheapest for each error (wall time interpolated between measured points, never beyond them):", "",
            *_table(["error", "cheapest", "wall (s)", "how"], rows), "",
            "Order of convergence, and wall time (s) to stay within an error:", ""]
    rows = []
    for variant, group in by_variant(points).items():
        fitted = order(group)
        reached = [reach(group, level) for level in LEVELS]
        rows.append((variant, "" if math.isnan(fitted) else f"{fitted:.1f}",
                     *(seconds(one.wall) if one else "" for one in reached)))
    return text + _table(["variant", "order", *(percent(level) for level in LEVELS)], rows)


def how_text(reached):
    """Whether a Reach was measured or interpolated."""
    if len(reached.between) == 1:
        return f"measured at {reached.between[0]}"
    return f"between {reached.between[0]} and {reached.between[1]}"
