"""The quantities of a sweep: means over time of each run, and means over seeds of each point."""

import math
from dataclasses import dataclass

from ..errors import MesogenError
from ..run import open as open_run
from ..runs.execution import results_of
from ..runs.statistics import standard_error, time_mean


def check_series(run, quantities):
    """Raises MesogenError if a quantity was not recorded, or is no single number per sample. run: mesogen.Run."""
    for quantity in quantities:
        if run.series(quantity.observer, quantity.series)[1].ndim != 1:
            raise MesogenError(f"'{quantity.observer}.{quantity.series}' is a table in each sample; a sweep collects "
                               "numbers")


@dataclass(frozen=True)
class RunValues:
    """The statistics.Mean of each quantity of one run. means: empty if the run is not done; `failure` says why."""

    run: object
    status: str
    failure: str
    means: tuple


@dataclass(frozen=True)
class Estimate:
    """Of a point: the mean over its runs and its standard error, in the unit of the series.

    over: where the error comes from, "seeds" or "blocks" of time; "" if it is unknown. block_error: the error from the
    variation within the runs alone.
    """

    mean: float
    error: float
    over: str
    block_error: float


@dataclass(frozen=True)
class PointValues:
    """A point: number of its finished runs and of all its runs, and an Estimate for each quantity."""

    point: object
    done: int
    wanted: int
    estimates: tuple


def run_values(records):
    """The RunValues of all runs of a sweep. Raises StudyError for a quantity that was not recorded."""
    return [_of_run(records, run) for run in records.sweep.runs]


def _of_run(records, run):
    row, quantities = records.row(run), records.sweep.quantities
    if row is None or row["status"] != "done":
        status = records.status(run)
        reason = row["reason"] if row else "was broken off" if status == "begun" else "has not run yet"
        return RunValues(run, status, reason, ())
    with results_of(records.results(run), records.sweep.file) as results:
        check_series(results, quantities)
        means = tuple(time_mean(*results.series(quantity.observer, quantity.series), quantity.start, quantity.end,
                                quantity.blocks, results.time_unit) for quantity in quantities)
    return RunValues(run, "done", "", means)


def units(sweep, values, folder_of):
    """Units of the quantities, read from the first finished run; "" if there is none. folder_of: function of a run."""
    one = next((value.run for value in values if value.status == "done"), None)
    if one is None:
        return [""] * len(sweep.quantities)
    with open_run(folder_of(one)) as results:
        return [results.series_unit(quantity.observer, quantity.series) for quantity in sweep.quantities]


def point_values(sweep, values):
    """The PointValues of all points, from the RunValues."""
    found = []
    for point in sweep.points:
        mine = [value for value in values if value.run.point == point]
        done = [value for value in mine if value.status == "done"]
        found.append(PointValues(point, len(done), len(mine), tuple(
            estimate([value.means[number] for value in done]) for number in range(len(sweep.quantities)))))
    return found


def estimate(means):
    """The Estimate over runs that differ in their seeds alone. means: statistics.Mean of each run.

    The error is over seeds if there are two runs or more, else over blocks of time.
    """
    known = [one for one in means if one.known]
    if not known:
        return Estimate(math.nan, math.nan, "", math.nan)
    by_blocks = math.sqrt(sum(one.error**2 for one in known)) / len(known)
    if len(known) > 1:
        values = [one.mean for one in known]
        return Estimate(sum(values) / len(values), standard_error(values), "seeds", by_blocks)
    return Estimate(known[0].mean, by_blocks, "blocks" if math.isfinite(by_blocks) else "", by_blocks)
