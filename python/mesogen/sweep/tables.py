"""The tables of a sweep: values.csv has one line per run, table.csv and table.md have one line per point."""

import math
import os

from ..errors import StudyError
from ..runs.ledger import csv_text, write_file
from ..runs.markdown import head_lines, table_lines
from ..runs.points import few, short_names, value_word
from ..runs.program import Program
from ..runs.records import Records
from ..units import time_unit
from .collection import point_values, run_values, units

NOTE = """\
± is the standard error: over the runs of a point where two or more are done (seeds), else over blocks of time in the one
that is (blocks). By blocks: what the variation in time within the runs alone would give; where it is much smaller than
the error over seeds, runs differ for longer than they last."""


def write_tables(sweep, folder, program=None):
    """Writes the tables of the finished runs. program: the command whose defaults runs must have; None: any.

    Returns (text of table.md, names of the files). Raises StudyError if no run has ended.
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
    """Keys that points change, in the order of their first appearance."""
    return list(dict.fromkeys(key for point in sweep.points for key in point.values))


def values_csv(sweep, values):
    """One line per run: mean, error over blocks, number of blocks and correlation time of each quantity."""
    keys = changed_keys(sweep)
    columns = ["run", "point", "seed", *keys, "status", "reason"]
    for quantity in sweep.quantities:
        columns += [quantity.name, f"{quantity.name} block_error", f"{quantity.name} blocks",
                    f"{quantity.name} correlation_time"]
    lines = []
    for one in values:
        line = [one.run.label, one.run.point.label, one.run.seed, *_cells(keys, one.run.point), one.status, one.failure]
        for mean in one.means:
            line += [mean.mean, mean.error, mean.blocks, mean.correlation_time]
        lines.append(line + [None] * (len(columns) - len(line)))
    return csv_text(columns, lines)


def points_csv(sweep, points):
    """One line per point: mean, standard error, what it is over, and error over blocks of each quantity."""
    keys = changed_keys(sweep)
    columns = ["point", *keys, "runs_done", "runs"]
    for quantity in sweep.quantities:
        columns += [quantity.name, *(f"{quantity.name} {what}" for what in ("error", "error_over", "block_error"))]
    lines = []
    for one in points:
        line = [one.point.label, *_cells(keys, one.point), one.done, one.wanted]
        for estimate in one.estimates:
            line += [estimate.mean, estimate.error, estimate.over, estimate.block_error]
        lines.append(line)
    return csv_text(columns, lines)


def markdown(sweep, values, points, its_units, rows):
    """The text of table.md. values, points: RunValues, PointValues; its_units: of the quantities; rows: of runs.csv."""
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
    """An Estimate as "0.1584 ± 0.0005 (seeds)"; "" without a mean."""
    if not math.isfinite(estimate.mean):
        return ""
    if not math.isfinite(estimate.error):
        return f"{estimate.mean:.4g}"
    places = _places(estimate.error, estimate.mean)
    return f"{estimate.mean:.{places}f} ± {estimate.error:.{places}f} ({estimate.over})"


def error_text(mean, error):
    """An error with as many decimals as estimate_text gives it; "" if it is unknown."""
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
