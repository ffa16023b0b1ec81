"""The finished runs of a sweep."""

from dataclasses import dataclass

from ..run import open as open_run
from .records import Records
from .sweep_file import Run


@dataclass(frozen=True)
class Finished:
    """A finished run, and the folder of its output."""

    run: Run
    folder: str

    @property
    def label(self):
        """The name of its folder: what was changed in the case, and the seed."""
        return self.run.label

    @property
    def point(self):
        """The Point that it belongs to."""
        return self.run.point

    @property
    def seed(self):
        """Its seed, None in a sweep without seeds."""
        return self.run.seed

    def open(self):
        """Its results, a mesogen.Run; close it, or use it as a context manager."""
        return open_run(self.folder)


def finished(sweep, folder):
    """The Finished of a sweep whose output is in the folder, in the order of the sweep; only those of the same case."""
    records = Records(sweep, folder)
    return [Finished(run, records.results(run)) for run in sweep.runs
            if (row := records.row(run)) and row["status"] == "done"]
