"""Runs a sweep on this machine, some runs at a time."""

import time

from ..study.errors import StudyError
from ..study.execution import PAUSE, command_line, refusals
from ..study.ledger import Ledger, locked
from ..study.progress import Progress, duration_text
from ..study.recorded import unfit_series
from .defaults import Program
from .execution import Attempt
from .points import few
from .records import COLUMNS, Records, identity


def run_sweep(sweep, folder, program="mesogen", parallel=None, progress=Progress, tell=print, retry=False):
    """Does what is missing.

    parallel: runs at a time, None: as the sweep has it. progress: called with (number of runs, how many are done), gives
    a study.progress.Progress. tell: takes a line about what is done again. retry: runs that failed are tried again.
    Raises StudyError if mesogen refuses a run, or an observer does not record a quantity, both before anything is run.
    When it raises, or is interrupted, its runs have ended and left checkpoints.
    """
    with locked(folder, busy_text(folder)):
        records = Records(sweep, folder, Program(program))
        records.claim()
        records.gather()
        waiting = prepare(records, tell, retry)
        shown = progress(len(sweep.runs), len(sweep.runs) - len(waiting))
        try:
            _work(records, waiting, parallel or sweep.at_a_time, shown)
        finally:
            shown.close()


def prepare(records, tell, retry):
    """The runs that are to be done, after a look at each. Raises StudyError with mesogen's own words."""
    waiting = records.missing(retry)
    last = {row["label"]: row for row in records.ledger.rows}
    for run in waiting:
        row = last.get(run.label)
        if row is not None and records.row(run) is None and not records.can_go_on(run):
            same = identity(row["key"], row["version"]) == records.identity(run)
            tell(f"{run.label} runs again: " + ("its results are gone" if same else
                                                "the sweep, its case or a default of mesogen has changed"))
    check(records.sweep, waiting, records.program.command)
    return waiting


def check(sweep, runs, program):
    """Lets mesogen look at every point, and at what its observers will record. Raises StudyError."""
    wanted = [(f"quantity[{number}].series", one.observer, one.series)
              for number, one in enumerate(sweep.quantities, start=1)]
    first = {}
    for run in runs:
        first.setdefault(run.point.label, run.overrides)
    said = refusals(program, sweep.case, first,
                    lambda recorded: unfit_series(recorded, wanted, "a sweep collects numbers"))
    if said:
        raise StudyError([f"{sweep.file}: {_points(names, len(sweep.points))}: {line}" for line, names in said.items()])


def _points(names, count):
    return "every point" if len(names) == count else few(names)


def _work(records, waiting, at_a_time, shown):
    waiting, going, walls = list(waiting), [], []
    try:
        while waiting or going:
            started = False
            while waiting and len(going) < at_a_time:
                going.append(Attempt(records, waiting.pop(0)))
                started = True
            if started:
                shown.start(", ".join(one.run.label for one in going),
                            _left(walls, len(waiting) + len(going), at_a_time))
            for one in list(going):
                row = one.poll()
                if row is not None:
                    records.ledger.add(row)
                    going.remove(one)
                    one.stop()
                    walls.append(row["wall_seconds"])
                    shown.end(row_text(row, one.resumed), one.run.label)
            shown.tick()
            time.sleep(PAUSE)
    finally:
        for one in going:
            one.ask()
        for one in going:
            one.stop()


def _left(walls, runs, at_a_time):
    """Expected s until all is done, None before the first has ended."""
    return sum(walls) / len(walls) * runs / at_a_time if walls else None


def row_text(row, resumed):
    wall = row["wall_seconds"]
    took = duration_text(wall) if wall >= 10 else f"{wall:.2g} s"
    text = f"done, {took}" if row["status"] == "done" else f"{row['status'].upper()}: {row['reason']}"
    return text + (", gone on with from its checkpoint" if resumed else "")


def run_task(sweep, run, folder, program, retry=False):
    """One run for a task of a job array, which shares its folder with others on other machines. Returns its row, None
    if there was nothing to do."""
    records = Records(sweep, folder, Program(program))
    if records.settled(run, retry) is not None:
        return None
    attempt = Attempt(records, run)
    try:
        while (row := attempt.poll()) is None:
            time.sleep(PAUSE)
        Ledger(records.state(run, "row.csv"), COLUMNS).add(row)
        return row
    finally:
        attempt.stop()


def list_runs(sweep, folder, program, write):
    """Every run, how it stands, and its command."""
    records = Records(sweep, folder, Program(program))
    for run in sweep.runs:
        write(f"{records.status(run):8} {run.label}: "
              + command_line(program, sweep.case, run.overrides, records.results(run), sweep.threads))


def busy_text(folder):
    return f"another sweep is writing into {folder}; choose another folder with --output, or wait"
