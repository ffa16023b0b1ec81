"""The state of a sweep's runs, as its folder holds it:

    owner               path of the sweep's file
    runs.csv            how each run ended
    runs/LABEL/         output of the run: results.h5, checkpoints, ...
    state/LABEL/key     key of the run whose output that is, and mesogen's defaults
    state/LABEL/row.csv how the run ended, if a task of a job array did it; the next sweep moves the line to runs.csv

A row of runs.csv belongs to the output in runs/LABEL only while both have the same key: a run that was started again
for another case has no row yet.
"""

import filecmp
import os

from ..errors import StudyError
from .ledger import Ledger, locked, stopped_too_early, write_file
from .program import split_version

COLUMNS = ("key", "label", "status", "reason", "wall_seconds", "cpu_seconds", "steps", "peak_memory", "date", "machine",
           "version")


class Records:
    """The records of a sweep in a folder. program: the Program that does the runs; None: runs of any program count."""

    def __init__(self, sweep, folder, program=None):
        self.sweep, self.folder, self.program = sweep, folder, program
        self.ledger = Ledger(os.path.join(folder, "runs.csv"), COLUMNS)

    def results(self, run):
        """The folder with the output of a run."""
        return os.path.join(self.folder, "runs", run.label)

    def state(self, run, *name):
        """The folder with the state of a run, or a file in it."""
        return os.path.join(self.folder, "state", run.label, *name)

    def claim(self):
        """Writes `owner`. Raises StudyError if another sweep has its runs in the folder."""
        note = os.path.join(self.folder, "owner")
        file = os.path.abspath(self.sweep.file)
        if os.path.exists(note):
            with open(note, encoding="utf-8") as stream:
                owner = stream.read().strip()
            if owner != file and os.path.exists(owner) and not filecmp.cmp(owner, file, shallow=False):
                raise StudyError(f"{self.folder} holds the runs of {owner}, another sweep: give --output DIR, or rename "
                                 f"{self.sweep.file}")
        os.makedirs(self.folder, exist_ok=True)
        write_file(note, file + "\n")

    def gather(self):
        """Moves the rows that tasks of a job array wrote to runs.csv."""
        for run in self.sweep.runs:
            row = self.state(run, "row.csv")
            if os.path.exists(row):
                for line in Ledger(row, COLUMNS).rows:
                    self.ledger.add(line)
                os.remove(row)

    def add_task_row(self, run, row):
        """Writes the row of a run that a task of a job array did."""
        Ledger(self.state(run, "row.csv"), COLUMNS).add(row)

    def row(self, run):
        """The row about the output of the run, None if it has not ended, or was done for another case or program."""
        task = self.state(run, "row.csv")
        rows = [*self.ledger.rows, *(Ledger(task, COLUMNS).rows if os.path.exists(task) else [])]
        row = next((row for row in reversed(rows) if row["label"] == run.label), None)
        if row is None or row["key"] != run.key or self._begun(run) != identity(row["key"], row["version"]):
            return None
        if self.program is not None and identity(row["key"], row["version"]) != self.identity(run):
            return None
        if row["status"] == "done" and not os.path.isfile(os.path.join(self.results(run), "results.h5")):
            return None
        return row

    def settled(self, run, retry=False):
        """The row of a run that need not be done (again), None if it must be.

        A run that failed would fail again, and one that was stopped for its time would be stopped again unless it has
        more time now. retry: such runs are tried again all the same.
        """
        row = self.row(run)
        if row is None or row["status"] == "done":
            return row
        again = row["status"] == "timeout" and stopped_too_early(row, self.sweep.timeout)
        return None if retry or again or row["status"] == "killed" else row

    def missing(self, retry=False):
        """The runs that must be done."""
        return [run for run in self.sweep.runs if self.settled(run, retry) is None]

    def status(self, run):
        """Of a run in one word: done, failed, timeout, killed; begun if it has a checkpoint to resume from; missing."""
        row = self.row(run)
        return row["status"] if row else "begun" if self.can_go_on(run) else "missing"

    def can_go_on(self, run):
        """Whether the run has a checkpoint, made for the same case."""
        begun = self._begun(run)
        mine = begun == self.identity(run) if self.program is not None else begun.split(" ")[0] == run.key
        files = (os.path.join(self.results(run), f"checkpoint_{letter}.h5") for letter in "ab")
        return mine and any(map(os.path.isfile, files))

    def begin(self, run):
        """Writes state/LABEL/key: from now on the output is that of this run."""
        write_file(self.state(run, "key"), self.identity(run))

    def version(self, run):
        """The text of the column `version` for a run by this program."""
        return self.program.version_for(self.sweep.data, run.overrides)

    def identity(self, run):
        return identity(run.key, self.version(run))

    def locked(self, run):
        """A context manager that keeps other processes from the run. Raises StudyError if another is doing it."""
        return locked(self.state(run), f"run {run.label}: another process is at it; wait for it")

    def _begun(self, run):
        try:
            with open(self.state(run, "key"), encoding="utf-8") as file:
                return file.read()
        except FileNotFoundError:
            return ""


def identity(key, version):
    """What a run depends on, as state/LABEL/key holds it: its key, and the digest of mesogen's defaults."""
    return f"{key} {split_version(version)[1]}"
