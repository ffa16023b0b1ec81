"""What is known of the runs of a sweep, in its folder:

    runs/LABEL/         what the run wrote: results.h5, checkpoints, ...
    owner               the sweep's file
    state/LABEL/key     for what that was begun: a run's key, and mesogen's defaults
    state/LABEL/row.csv how it ended, where a task of a job array did it; the next sweep moves it to runs.csv
    runs.csv            how each ended

A row of runs.csv is about what lies in runs/ only while the key there is that of the row: a run that was begun again
for another case has no row yet.
"""

import filecmp
import os

from ..study.errors import StudyError
from ..study.ledger import Ledger, locked, write_file
from ..study.machine import DEFAULTS

COLUMNS = ("key", "label", "status", "reason", "wall_seconds", "cpu_seconds", "steps", "peak_memory", "date", "machine",
           "version")


class Records:
    """The records of a sweep in a folder. program: defaults.Program that does the runs; None: any did."""

    def __init__(self, sweep, folder, program=None):
        self.sweep, self.folder, self.program = sweep, folder, program
        self.ledger = Ledger(os.path.join(folder, "runs.csv"), COLUMNS)

    def results(self, run):
        """The folder of a run."""
        return os.path.join(self.folder, "runs", run.label)

    def state(self, run, *name):
        return os.path.join(self.folder, "state", run.label, *name)

    def claim(self):
        """Notes whose folder this is. Raises StudyError if another sweep, of the same name, has its runs there."""
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
        """Moves what tasks of a job array wrote to the ledger."""
        for run in self.sweep.runs:
            row = self.state(run, "row.csv")
            if os.path.exists(row):
                for line in Ledger(row, COLUMNS).rows:
                    self.ledger.add(line)
                os.remove(row)

    def row(self, run):
        """The row about what lies in the run's folder, None if it has yet to end, or was another."""
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
        """The row of a run that is not to be done (again). A run that failed fails again, one that was stopped for its
        time is again while there is no more of it; retry: all that is not done is tried again."""
        row = self.row(run)
        if row is None or row["status"] == "done":
            return row
        if row["status"] == "timeout" and not (self.sweep.timeout and float(row["wall_seconds"]) >= self.sweep.timeout):
            return None
        return None if retry or row["status"] == "killed" else row

    def missing(self, retry=False):
        """The runs that are to be done."""
        return [run for run in self.sweep.runs if self.settled(run, retry) is None]

    def status(self, run):
        """Of a run in a word: done, failed, timeout, killed; begun if it was broken off and can go on; missing."""
        row = self.row(run)
        return row["status"] if row else "begun" if self.can_go_on(run) else "missing"

    def can_go_on(self, run):
        """Whether there is a checkpoint of this very run."""
        begun = self._begun(run)
        mine = begun == self.identity(run) if self.program is not None else begun.split(" ")[0] == run.key
        files = (os.path.join(self.results(run), f"checkpoint_{letter}.h5") for letter in "ab")
        return mine and any(map(os.path.isfile, files))

    def begin(self, run):
        """Notes for what the run's folder is from now on."""
        write_file(self.state(run, "key"), self.identity(run))

    def version(self, run):
        """Of the program, with the defaults that the run depends on."""
        return self.program.version_for(self.sweep.data, run.overrides)

    def identity(self, run):
        return identity(run.key, self.version(run))

    def locked(self, run):
        """The run for this process alone, as a context manager. Raises StudyError if another is at it."""
        return locked(self.state(run), f"run {run.label}: another process is at it; wait for it")

    def _begun(self, run):
        try:
            with open(self.state(run, "key"), encoding="utf-8") as file:
                return file.read()
        except FileNotFoundError:
            return ""


def identity(key, version):
    """The key of a run and the defaults of mesogen that it was done with."""
    return f"{key} {version.partition(DEFAULTS)[2]}"
