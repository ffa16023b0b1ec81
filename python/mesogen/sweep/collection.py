"""What came out of a sweep: means of each run, and of each point over its seeds."""

import math
from dataclasses import dataclass

from ..errors import MesogenError
from ..run import open as open_run
from ..study.errors import StudyError
from .records import Records
from .statistics import standard_error, time_mean


@dataclass(frozen=True)
class Finished:
    """A run that is done, and its folder."""

    run: object  # sweep_file.Run
    folder: str

    @property
    def label(self):
        return self.run.label

    @property
    def point(self):
        return self.run.point

    @property
    def seed(self):
        return self.run.seed

    def open(self):
        """Its results, a mesogen.Run; close it, or use it as a context manager."""
        return open_run(self.folder)


def finished(sweep, folder):
    """The runs that are done, in the order of the sweep: list of Finished. Those of another form of the sweep are not
    among them."""
    records = Records(sweep, folder)
    return [Finished(run, records.results(run)) for run in sweep.runs
            if (row := records.row(run)) and row["status"] == "done"]


def check_series(run, quantities):
    """Raises MesogenError if a quantity was not recorded, or is no number. run: mesogen.Run."""
    for quantity in quantities:
        if run.series(quantity.observer, quantity.series)[1].ndim != 1:
            raise MesogenError(f"'{quantity.observer}.{quantity.series}' is a table in each sample; a sweep collects "
                               "numbers")


@dataclass(frozen=True)
class RunValues:
    """The means of one run, by quantity; none where it is not done, and `failure` says why."""

    run: object
    status: str
    failure: str
    means: tuple


@dataclass(frozen=True)
class Estimate:
    """Of a point: the mean over its runs and its standard error, over `over`: "seeds", "blocks", or "" where it is not
    known. block_error: from the variation within the runs alone. Units of the series."""

    mean: float
    error: float
    over: str
    block_error: float


@dataclass(frozen=True)
class PointValues:
    """A point: how many of its runs are done, of how many, and an Estimate for each quantity."""

    point: object
    done: int
    wanted: int
    estimates: tuple


def run_values(records):
    """RunValues of all runs of a sweep. Raises StudyError for a quantity that was not recorded."""
    return [_of_run(records, run) for run in records.sweep.runs]


def _of_run(records, run):
    row, quantities = records.row(run), records.sweep.quantities
    if row is None or row["status"] != "done":
        status = records.status(run)
        reason = row["reason"] if row else "was broken off" if status == "begun" else "has not run yet"
        return RunValues(run, status, reason, ())
    try:
        with open_run(records.results(run)) as results:
            check_series(results, quantities)
            means = tuple(time_mean(*results.series(quantity.observer, quantity.series), quantity.start, quantity.end,
                                    quantity.blocks, results.time_unit) for quantity in quantities)
    except MesogenError as error:
        raise StudyError(f"{records.sweep.file}: {error}") from error
    return RunValues(run, "done", "", means)


def units(sweep, values, folder_of):
    """Units of the quantities, of the first run that is done; "" without any."""
    one = next((value.run for value in values if value.status == "done"), None)
    if one is None:
        return [""] * len(sweep.quantities)
    with open_run(folder_of(one)) as results:
        return [results.series_unit(quantity.observer, quantity.series) for quantity in sweep.quantities]


def point_values(sweep, values):
    """PointValues of all points, from the RunValues."""
    found = []
    for point in sweep.points:
        mine = [value for value in values if value.run.point == point]
        done = [value for value in mine if value.status == "done"]
        found.append(PointValues(point, len(done), len(mine), tuple(
            estimate([value.means[number] for value in done]) for number in range(len(sweep.quantities)))))
    return found


def estimate(means):
    """The Estimate over runs that differ in their seeds alone. means: of statistics.Mean.

    The error is over seeds where there are two or more; of one run it is over blocks of time.
    """
    known = [one for one in means if one.known]
    if not known:
        return Estimate(math.nan, math.nan, "", math.nan)
    by_blocks = math.sqrt(sum(one.error**2 for one in known)) / len(known)
    if len(known) > 1:
        values = [one.mean for one in known]
        return Estimate(sum(values) / len(values), standard_error(values), "seeds", by_blocks)
    return Estimate(known[0].mean, by_blocks, "blocks" if math.isfinite(by_blocks) else "", by_blocks)
