"""The tables of a stability study: Markdown for people, CSV for programs."""

import re

from ..runs.ledger import csv_text
from ..runs.markdown import head_lines, table_lines


def state_of(found):
    """The state of a search (Found) in words."""
    if not found.complete:
        return "not searched to its end"
    if found.holds:
        return "holds over the whole range"
    if found.fails:
        return "fails over the whole range"
    return "boundary"


def _lines(found):
    """(value that holds, value that fails, row) of each boundary; without any, (None, None, first row that fails)."""
    return found.edges or [(None, None, next((row for row in found.rows.values() if row["how"]), None))]


def boundaries_csv(study, searches):
    """The text of boundaries.csv: one line per boundary, and one per search without any."""
    columns = ("variant", study.across_key or "across", "state", "inside", "outside", "how", "time", "reason", "runs")
    rows = [(found.cell.variant.name, found.cell.across, state_of(found), inside, outside,
             *(row[name] if row else None for name in ("how", "time", "reason")), len(found.rows))
            for found in searches for inside, outside, row in _lines(found)]
    return csv_text(columns, rows)


def markdown(study, searches, rows, command):
    """The text of map.md. rows: of runs.csv; command: function of (cell, value, name of output), gives a shell line."""
    sweep = study.sweep
    lines = [f"# {study.title}", "", f"`{study.sweep_key}` from {sweep.first:g} to {sweep.last:g}"
             + (f", for `{study.across_key}` = {', '.join(map(str, study.across_values))}" if study.across_key else "")
             + f", each run to t = {study.end:g} {study.scene.time_unit}. Scene: {study.scene.case}.", "",
             *head_lines(rows), "", _bounds_text(study), "", *_notes(study), *_table(study, searches), ""]
    if study.remedy:
        lines += [f"Remedy: {study.remedy.strip()}", ""]
    lines += _commands(study, searches, command)
    return "\n".join(lines) + "\n"


def _bounds_text(study):
    b = study.bounds
    said = [words for bound, words in (
        (b.clumping, f"two particles nearer than {b.clumping} spacings (clumping)"),
        (b.volume, f"a volume changed by more than {_percent(b.volume)} (volume)"),
        (b.density, f"a density changed by more than {_percent(b.density)} (density)"),
        (b.energy, f"kinetic energy grown by more than {_percent(b.energy)} (energy)"),
        (b.order, f"a mean order changed by more than {b.order} (order)"),
        (b.momentum, f"momentum changed by more than {_percent(b.momentum)} of mass x speed (momentum)"),
        (b.error, f"an error above {_percent(b.error)} (error)"),
    ) if bound is not None]
    after = f" Looked at from t = {b.after:g} {study.scene.time_unit} on." if b.after else ""
    return "A run fails if mesogen stops it, or by " + ", ".join(said) + "." + after


def _notes(study):
    notes = [f"`{variant.name}`: {variant.note}" for variant in study.variants if variant.note]
    return [f"Variants: {'; '.join(notes)}.", ""] if notes else []


def _percent(bound):
    return f"{100 * bound:g} %" if bound is not None else ""


def _table(study, searches):
    rows = []
    for found in searches:
        start = (found.cell.variant.name, *([str(found.cell.across)] if study.across_key else []))
        for inside, outside, row in _lines(found):
            ends = ("", "") if inside is None else (f"{inside:g}", f"{outside:g}")
            how, time, reason = (row["how"], f"{float(row['time']):.3g}", row["reason"]) if row else ("", "", "")
            first = reason if found.edges else ": ".join(filter(None, (state_of(found), reason)))
            rows.append((*start, *ends, how, time, first))
    header = ["variant", *([study.across_key] if study.across_key else []), "holds at", "fails at", "how",
              f"t ({study.scene.time_unit})", "first"]
    return table_lines(header, rows, left=("variant", "how", "first"))


def _commands(study, searches, command):
    lines = []
    for found in searches:
        for number, (inside, outside, row) in enumerate(found.edges, start=1):
            stem = "_".join(re.findall(r"[\w.-]+", found.cell.name) + ([str(number)] if len(found.edges) > 1 else []))
            lines += [f"# {found.cell.name}: holds", command(found.cell, inside, f"{stem}_inside"),
                      f"# {found.cell.name}: fails, {row['how']} at t = {float(row['time']):.3g} {study.scene.time_unit}",
                      command(found.cell, outside, f"{stem}_outside")]
    return ["Just inside and just outside of each boundary:", "", "```sh", *lines, "```", ""] if lines else []
