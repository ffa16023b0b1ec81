"""The tables of a sweep: values.csv, a line a run; table.csv and table.md, a line a point."""

import math
import os

from ..study.errors import StudyError
from ..study.ledger import csv_text, write_file
from ..study.markdown import head_lines, table_lines
from ..units import time_unit
from .collection import point_values, run_values, units
from .defaults import Program
from .points import few, short_names, value_word
from .records import Records

NOTE = """\
± is the standard error: over the runs of a point where two or more are done (seeds), else over blocks of time in the one
that is (blocks). By blocks: what the variation in time within the runs alone would give; where it is much smaller than
the error over seeds, runs differ for longer than they last."""


def write_tables(sweep, folder, program=None):
    """Writes the tables of what is there. program: the mesogen whose defaults runs must have, None: of any.

    Returns (the text of table.md, names of the files). Raises StudyError where nothing has run.
    """
    records = Records(sweep, folder, Program(program) if program else None)
    rows = [row for run in sweep.runs if (row := records.row(run))]
    if not rows:
        raise StudyError(f"{folder}: nothing has run yet; leave out --collect-only")
    values = run_values(records)
    points = point_values(sweep, values)
    text = markdown(sweep, values, points, units(sweep, values, records.results), rows)
    names = [os.path.join(folder, name) for name in ("values.csv", "table.csv", "table.md")]
    for name, content in zip(names, (values_csv(sweep, values), points_csv(sweep, points), text), strict=True):
        write_file(name, content)
    return text, names


def changed_keys(sweep):
    """Keys that some point changes, in the order of their first appearance."""
    return list(dict.fromkeys(key for point in sweep.points for key in point.values))


def values_csv(sweep, values):
    """A line a run: mean, error by blocks, their number and the correlation time (s) of each quantity."""
    keys = changed_keys(sweep)
    columns = ["run", "point", "seed", *keys, "status", "reason"]
    for quantity in sweep.quantities:
        columns += [quantity.name, f"{quantity.name} block_error", f"{quantity.name} blocks",
                    f"{quantity.name} correlation_time"]
    lines = []
    for one in values:
        line = [one.run.label, one.run.point.label, one.run.seed, *_cells(keys, one.run.point), one.status, one.failure]
        for mean in one.means:
            line += [_number(mean.mean), _number(mean.error), mean.blocks, _number(mean.correlation_time)]
        lines.append(line + [None] * (len(columns) - len(line)))
    return csv_text(columns, lines)


def points_csv(sweep, points):
    """A line a point: mean, standard error and what it is over, and the error by blocks of each quantity."""
    keys = changed_keys(sweep)
    columns = ["point", *keys, "runs_done", "runs"]
    for quantity in sweep.quantities:
        columns += [quantity.name, *(f"{quantity.name} {what}" for what in ("error", "error_over", "block_error"))]
    lines = []
    for one in points:
        line = [one.point.label, *_cells(keys, one.point), one.done, one.wanted]
        for estimate in one.estimates:
            line += [_number(estimate.mean), _number(estimate.error), estimate.over or None,
                     _number(estimate.block_error)]
        lines.append(line)
    return csv_text(columns, lines)


def markdown(sweep, values, points, its_units, rows):
    """The text of table.md."""
    keys = changed_keys(sweep)
    names = short_names(keys)
    header = ["point", *(names[key] for key in keys), "runs"]
    for quantity, unit in zip(sweep.quantities, its_units, strict=True):
        header += [quantity.name + (f" ({unit})" if unit not in ("", "1") else ""), "by blocks"]
    lines = []
    for one in points:
        done = str(one.done) if one.done == one.wanted else f"{one.done} of {one.wanted}"
        line = [one.point.label or "the case", *(cell or "" for cell in _cells(keys, one.point)), done]
        for estimate in one.estimates:
            line += [estimate_text(estimate), error_text(estimate.mean, estimate.block_error)]
        lines.append(line)
    text = [f"# {sweep.title}", "", f"Case: {sweep.case}", "", *head_lines(rows), "",
            *table_lines(header, lines, ["point"]), "", *_spans(sweep), "", NOTE]
    remarks = [*_failures(values), *_problems(sweep, values)]
    return "\n".join([*text, *(["", *remarks] if remarks else [])]) + "\n"


def estimate_text(estimate):
    """As 0.1584 ± 0.0005 (seeds); nothing where there is no mean."""
    if not math.isfinite(estimate.mean):
        return ""
    if not math.isfinite(estimate.error):
        return f"{estimate.mean:.4g}"
    places = _places(estimate.error, estimate.mean)
    return f"{estimate.mean:.{places}f} ± {estimate.error:.{places}f} ({estimate.over})"


def error_text(mean, error):
    """An error with as many decimals as beside its mean."""
    return f"{error:.{_places(error, mean)}f}" if math.isfinite(error) else ""


def _places(error, mean):
    """Decimals that show two digits of the error; at most eight digits of the mean."""
    scale = error if error > 0 else abs(mean) * 1e-4
    return min(12, max(0, 1 - math.floor(math.log10(scale)))) if scale > 0 else 0


def _spans(sweep):
    lines = []
    unit = time_unit(sweep.data)
    for one in sweep.quantities:
        span = f"after {one.start:g} {unit}" if math.isfinite(one.start) else "from the start"
        span += f" up to {one.end:g} {unit}" if math.isfinite(one.end) else " to the end"
        series = f"{one.observer}.{one.series}"
        lines.append(f"{one.name}: mean" + (f" of {series}" if series != one.name else "") + f" {span}.")
    return lines


def _failures(values):
    def word(status):
        return status if status in ("begun", "missing") else status.upper()

    found = _alike((f"{word(one.status)}: {one.failure}", one.run.label) for one in values if one.failure)
    return [f"- {', '.join(labels)}: {text}" for text, labels in found.items()]


def _problems(sweep, values):
    found = _alike((f"{quantity.name} {mean.problem}", one.run.label)
                   for one in values for quantity, mean in zip(sweep.quantities, one.means) if mean.problem)
    return [f"- {few(labels)}: {text}" for text, labels in found.items()]


def _alike(pairs):
    """{text: [labels]}"""
    found = {}
    for text, label in pairs:
        found.setdefault(text, []).append(label)
    return found


def _cells(keys, point):
    return [value_word(point.values[key]) if key in point.values else None for key in keys]


def _number(value):
    return value if math.isfinite(value) else None
