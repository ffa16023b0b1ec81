"""Runs a stability study and writes what it shows."""

import os
import shutil
import time
from dataclasses import dataclass
from datetime import datetime, timezone

import mesogen

from ..errors import NoResults
from .drawing import look, stability_map
from .errors import StudyError
from .execution import command_line, execute, refusals
from .judge import CRITERIA, Verdict, judge, unfit_to_judge, way_of
from .ledger import Ledger, locked, write_file
from .machine import machine_text, of_same_defaults, program_text
from .progress import Progress, duration_text
from .recorded import unfit_answer
from .search import boundaries, next_value
from .stability_tables import boundaries_csv, markdown

COLUMNS = ("key", "variant", "across", "value", "how", "time", "reason", *CRITERIA, "wall_seconds", "date", "machine",
           "version")


@dataclass(frozen=True)
class Found:
    """What the search of one cell has come to. `edges`: (inside, outside, the row of the run outside)."""

    cell: object
    rows: dict  # {value: row}
    edges: list
    complete: bool

    @property
    def holds(self):
        return all(not row["how"] for row in self.rows.values())

    @property
    def fails(self):
        return all(row["how"] for row in self.rows.values())


def found_of(study, cell, rows):
    """The Found of a cell from the ledger's rows: walks the search as far as runs are known."""
    by_key = {row["key"]: row for row in rows}
    known = {}
    while (value := next_value(study.sweep, {v: not row["how"] for v, row in known.items()})) is not None:
        row = by_key.get(study.key(cell, value))
        if row is None or (row["how"] == "too slow" and not too_slow(study, row)):
            break
        known[value] = row
    edges = [(inside, outside, known[outside]) for inside, outside in
             boundaries({v: not row["how"] for v, row in known.items()})]
    return Found(cell, known, edges, value is None), value


def too_slow(study, row):
    """Whether a run that was stopped for its time would be stopped again."""
    return study.timeout is not None and float(row["wall_seconds"]) >= study.timeout


def list_runs(study, folder, program, write):
    """Every run that is done, and the next of each search."""
    rows = of_same_defaults(Ledger(os.path.join(folder, "runs.csv"), COLUMNS).rows, program)
    for cell in study.cells():
        found, following = found_of(study, cell, rows)
        for value, row in sorted(found.rows.items()):
            write(f"{row['how'] or 'held':8} {cell.name}, {value:g}: {command_of(study, program, cell, value, folder, 'run')}")
        if following is not None:
            write(f"next     {cell.name}, {following:g}: {command_of(study, program, cell, following, folder, 'run')}")


def command_of(study, program, cell, value, folder, name):
    return command_line(program, study.scene.case, study.overrides(cell, value), os.path.join(folder, name),
                        study.threads)


def run_study(study, folder, program, progress_of=Progress, tell=print):
    """Searches until every boundary is found. Raises StudyError if mesogen refuses a variant at either end."""
    with locked(folder):
        ledger = Ledger(os.path.join(folder, "runs.csv"), COLUMNS)
        everything = len(ledger.rows)
        ledger.rows = of_same_defaults(ledger.rows, program)
        searches = [found_of(study, cell, ledger.rows) for cell in study.cells()]
        if all(found.complete for found, _ in searches):
            return
        if everything and not any(found.rows for found, _ in searches):
            tell("all runs are done again: the study, its case, its answer or a default of mesogen has changed")
        check_variants(study, program)
        done = sum(len(found.rows) for found, _ in searches)
        progress = progress_of(done + to_come(study, searches), done)
        where = {"machine": machine_text(), "version": program_text(program)}
        try:
            for number, cell in enumerate(study.cells()):
                while True:
                    searches[number] = found_of(study, cell, ledger.rows)
                    value = searches[number][1]
                    progress.total = progress.done + to_come(study, searches)
                    if value is None:
                        break
                    progress.start(f"{cell.name}, {study.sweep_key} = {value:g}", time_left(study, searches, ledger.rows))
                    row = run_trial(study, cell, value, folder, program, progress.tick)
                    ledger.add({**row, **where})
                    progress.end(f"FAILS, {row['how']} at t = {row['time']:.3g} {study.scene.time_unit}: {row['reason']}" if row["how"] else
                                 f"holds, {duration_text(row['wall_seconds'])}")
        finally:
            progress.close()
            shutil.rmtree(os.path.join(folder, "run"), ignore_errors=True)


def to_come(study, searches):
    """How many runs there are still at most."""
    return sum(max(1, study.sweep.most_trials() - len(found.rows)) for found, _ in searches if not found.complete)


def time_left(study, searches, rows):
    """Expected s, None before the first run."""
    keys = {study.key(found.cell, value) for found, _ in searches for value in found.rows}
    walls = [float(row["wall_seconds"]) for row in rows if row["key"] in keys]
    return to_come(study, searches) * sum(walls) / len(walls) if walls else None


def check_variants(study, program):
    """Lets mesogen look at both ends of every cell. Raises StudyError with mesogen's own words."""
    def name(place):
        return f"{place[0]}, {study.sweep_key} = {place[1]:g}"

    said = refusals(program, study.scene.case, {
        (cell.name, value): study.overrides(cell, value)
        for cell in study.cells() for value in (study.sweep.first, study.sweep.last)},
        lambda recorded: [*unfit_to_judge(recorded, study.bounds),
                          *(unfit_answer(recorded, study.scene.answer) if study.bounds.error is not None else ())])
    if said:
        raise StudyError([f"{study.file}: {'; '.join(map(name, places))}: {line}" for line, places in said.items()])


def run_trial(study, cell, value, folder, program, tick):
    """One run and its verdict, as a row of the ledger."""
    results = os.path.join(folder, "run")
    begun = time.monotonic()
    outcome = execute(program, study.scene.case, study.overrides(cell, value), results, study.threads, study.timeout, tick)
    try:
        with mesogen.open(results) as run:
            quantities = study.scene.answer.quantities if study.scene.answer else ()
            verdict = judge(run, study.bounds, quantities, outcome.reason)
    except NoResults:  # it ended before it wrote anything
        verdict = Verdict(way_of(outcome.reason), 0.0, outcome.reason, {})
    shutil.rmtree(results, ignore_errors=True)
    return {"key": study.key(cell, value), "variant": cell.variant.name, "across": cell.across, "value": value,
            "how": verdict.how, "time": verdict.time, "reason": verdict.reason, **verdict.extremes,
            "wall_seconds": time.monotonic() - begun,
            "date": datetime.now(timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")}


def write_outputs(study, folder, program):
    """Map and tables of what is there. Returns (the table's text, names of files written)."""
    rows = of_same_defaults(Ledger(os.path.join(folder, "runs.csv"), COLUMNS).rows, program)
    searches = [found_of(study, cell, rows)[0] for cell in study.cells()]
    if not any(found.rows for found in searches):
        raise StudyError(f"{folder}: nothing has run yet; leave out --draw-only")
    shown = [row for found in searches for row in found.rows.values()]
    def command(cell, value, name):
        return command_of(study, os.path.basename(program), cell, value, "output", name)
    text = markdown(study, searches, shown, command)
    names = [os.path.join(folder, name) for name in ("boundaries.csv", "map.md")]
    write_file(names[0], boundaries_csv(study, searches))
    write_file(names[1], text)
    with look.settings():
        names += look.save(stability_map.draw(study, searches), os.path.join(folder, "map"))
    return text, names
