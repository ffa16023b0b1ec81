"""Runs a sweep on this machine, several runs at a time."""

import time

from .attempt import Attempt
from .check import check_cases, unfit_series
from .execution import PAUSE
from .ledger import locked
from .points import few
from .program import Program
from .progress import Progress, wall_text
from .records import Records, identity


def run_sweep(sweep, folder, program="mesogen", parallel=None, progress=Progress, tell=print, retry=False):
    """Does the runs that are missing in the folder.

    program: the command `mesogen`. parallel: runs at a time, None: as the sweep has it. progress: function of (number
    of runs, number of finished runs) that gives a runs.progress.Progress. tell: takes a message for each run that is
    done again. retry: runs that failed are tried again.

    Raises StudyError if mesogen refuses a run, or no observer records a quantity, before the first run starts. After
    an error or an interrupt no run is in progress; each has left a checkpoint.
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
    """The runs that must be done, checked; tell gets a message for each that is done again. Raises StudyError."""
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
    """Asks mesogen about every point of the runs, and whether the quantities will be recorded. Raises StudyError."""
    wanted = [(f"quantity[{number}].series", one.observer, one.series)
              for number, one in enumerate(sweep.quantities, start=1)]
    first = {}
    for run in runs:
        first.setdefault(run.point.label, run.overrides)
    check_cases(sweep.file, program, sweep.case, first,
                lambda recorded: unfit_series(recorded, wanted, "a sweep collects numbers"),
                lambda names: "every point" if len(names) == len(sweep.points) else few(names))


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
    """Expected s until all runs are done, None before the first has ended."""
    return sum(walls) / len(walls) * runs / at_a_time if walls else None


def row_text(row, resumed):
    """How a run ended, for the terminal."""
    text = (f"done, {wall_text(row['wall_seconds'])}" if row["status"] == "done" else
            f"{row['status'].upper()}: {row['reason']}")
    return text + (", gone on with from its checkpoint" if resumed else "")


def busy_text(folder):
    """The error of a folder that another sweep is using."""
    return f"another sweep is writing into {folder}; choose another folder with --output, or wait"
