"""Runs a stability study, and writes its tables and map."""

import os
import shutil
import time
from dataclasses import dataclass

from ..errors import NoResults, StudyError
from ..run import open as open_run
from ..runs.check import check_cases
from ..runs.execution import command_line, execute
from ..runs.ledger import locked, stopped_too_early, write_file
from ..runs.program import Program, of_same_defaults, stamp
from ..runs.progress import Progress, duration_text
from .drawing import look, stability_map
from .judge import CRITERIA, Verdict, judge, unfit_to_judge, way_of
from .parts import ledger_of
from .search import boundaries, next_value
from .stability_tables import boundaries_csv, markdown

COLUMNS = ("key", "variant", "across", "value", "how", "time", "reason", *CRITERIA, "wall_seconds", "date", "machine",
           "version")


@dataclass(frozen=True)
class Found:
    """The state of one search. edges: (value that holds, value that fails, row of the run that fails) per boundary."""

    cell: object
    rows: dict  # {value: row}
    edges: list
    complete: bool

    @property
    def holds(self):
        """Whether all its runs held."""
        return all(not row["how"] for row in self.rows.values())

    @property
    def fails(self):
        """Whether all its runs failed."""
        return all(row["how"] for row in self.rows.values())


def found_of(study, cell, rows):
    """(Found, value to try next or None) of a cell, from the rows of runs.csv."""
    by_key = {row["key"]: row for row in rows}
    known = {}
    while (value := next_value(study.sweep, {v: not row["how"] for v, row in known.items()})) is not None:
        row = by_key.get(study.key(cell, value))
        if row is None or (row["how"] == "too slow" and stopped_too_early(row, study.timeout)):
            break
        known[value] = row
    edges = [(inside, outside, known[outside]) for inside, outside in
             boundaries({v: not row["how"] for v, row in known.items()})]
    return Found(cell, known, edges, value is None), value


def list_runs(study, folder, program, write):
    """Calls write with a line for each finished run, and one for the next run of each search."""
    rows = of_same_defaults(ledger_of(folder, COLUMNS).rows, program)
    for cell in study.cells():
        found, following = found_of(study, cell, rows)
        for value, row in sorted(found.rows.items()):
            write(f"{row['how'] or 'held':8} {cell.name}, {value:g}: "
                  + command_of(study, program, cell, value, folder, "run"))
        if following is not None:
            write(f"next     {cell.name}, {following:g}: {command_of(study, program, cell, following, folder, 'run')}")


def command_of(study, program, cell, value, folder, name):
    """The run of a cell at a value as one line for a shell. name: of its output in the folder."""
    return command_line(program, study.scene.case, study.overrides(cell, value), os.path.join(folder, name),
                        study.threads)


def run_study(study, folder, program, progress_of=Progress, tell=print):
    """Does runs until every search has ended. Raises StudyError if mesogen refuses a variant at either end."""
    with locked(folder):
        ledger = ledger_of(folder, COLUMNS)
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
        version = Program(program).version_for()
        try:
            for number, cell in enumerate(study.cells()):
                while True:
                    searches[number] = found_of(study, cell, ledger.rows)
                    value = searches[number][1]
                    progress.total = progress.done + to_come(study, searches)
                    if value is None:
                        break
                    progress.start(f"{cell.name}, {study.sweep_key} = {value:g}",
                                   time_left(study, searches, ledger.rows))
                    row = run_trial(study, cell, value, folder, program, progress.tick)
                    ledger.add({**row, **stamp(version)})
                    progress.end(row_text(study, row))
        finally:
            progress.close()
            shutil.rmtree(os.path.join(folder, "run"), ignore_errors=True)


def row_text(study, row):
    """How a run ended, for the terminal."""
    if row["how"]:
        return f"FAILS, {row['how']} at t = {row['time']:.3g} {study.scene.time_unit}: {row['reason']}"
    return f"holds, {duration_text(row['wall_seconds'])}"


def to_come(study, searches):
    """Largest number of runs that are still to do."""
    return sum(max(1, study.sweep.most_trials() - len(found.rows)) for found, _ in searches if not found.complete)


def time_left(study, searches, rows):
    """Expected s until all searches have ended, None before the first run."""
    keys = {study.key(found.cell, value) for found, _ in searches for value in found.rows}
    walls = [float(row["wall_seconds"]) for row in rows if row["key"] in keys]
    return to_come(study, searches) * sum(walls) / len(walls) if walls else None


def check_variants(study, program):
    """Asks mesogen about every cell at both ends of the range. Raises StudyError with mesogen's own words."""
    check_cases(study.file, program, study.scene.case, {
        f"{cell.name}, {study.sweep_key} = {value:g}": study.overrides(cell, value)
        for cell in study.cells() for value in (study.sweep.first, study.sweep.last)},
        lambda recorded: [*unfit_to_judge(recorded, study.bounds),
                          *(study.scene.answer.unfit(recorded) if study.bounds.error is not None else ())],
        "; ".join)


def run_trial(study, cell, value, folder, program, tick):
    """Does one run, and returns its row of runs.csv with the verdict. Its output is removed."""
    results = os.path.join(folder, "run")
    begun = time.monotonic()
    outcome = execute(program, study.scene.case, study.overrides(cell, value), results, study.threads, study.timeout,
                      tick)
    try:
        with open_run(results) as run:
            quantities = study.scene.answer.quantities if study.scene.answer else ()
            verdict = judge(run, study.bounds, quantities, outcome.reason)
    except NoResults:  # it was stopped before its first sample
        verdict = Verdict(way_of(outcome.reason), 0.0, outcome.reason, {})
    shutil.rmtree(results, ignore_errors=True)
    return {"key": study.key(cell, value), "variant": cell.variant.name, "across": cell.across, "value": value,
            "how": verdict.how, "time": verdict.time, "reason": verdict.reason, **verdict.extremes,
            "wall_seconds": time.monotonic() - begun}


def write_outputs(study, folder, program):
    """Writes tables and map of the finished runs. Returns (text of the table, names of the files)."""
    rows = of_same_defaults(ledger_of(folder, COLUMNS).rows, program)
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
