"""The finished runs of a sweep, as sections of a report use them."""

import math
import warnings
from dataclasses import dataclass, field

import numpy as np

from ..errors import MesogenError
from ..runs.statistics import time_mean
from ..runs.table_reader import nearest
from .estimate import over_seeds


@dataclass
class Results:
    """Finished runs of one sweep, in its order. missing: (label, reason) of the runs that are not finished."""

    name: str
    runs: list
    missing: list = field(default_factory=list)

    def where(self, **conditions):
        """The Results of the runs with these values of keys; a dot is written as two underscores:
        where(physics__activity__activity=0.023). Raises NothingThere if there is no such run."""
        wanted = {key.replace("__", "."): value for key, value in conditions.items()}
        known = {key for one in self.runs for key in one.run.overrides}
        for key in wanted:
            if self.runs and key not in known:
                raise NothingThere(f"no run of {self.name} has '{key}'{nearest(key, sorted(known))}")
        name = self.name + "".join(f", {key} = {value}" for key, value in wanted.items())
        found = [one for one in self.runs
                 if all(_same(one.run.overrides.get(key), value) for key, value in wanted.items())]
        if self.runs and not found:
            there = "; ".join(f"{key} is one of: {', '.join(map(str, self.points(key)))}" for key in wanted)
            raise NothingThere(f"there is no finished run of {name}; in those that there are {there}")
        return Results(name, found)

    def points(self, key):
        """The values of a key, in the order of the sweep. Raises NothingThere if there is no run."""
        self.first()
        values = []
        for one in self.runs:
            value = one.run.overrides.get(key)
            if value is not None and not any(_same(value, other) for other in values):
                values.append(value)
        return values

    def first(self):
        """The first run. Raises NothingThere if there is none."""
        if not self.runs:
            raise NothingThere(f"there is no finished run of {self.name}")
        return self.runs[0]

    def value(self, key):
        """The value of a dotted key in the case of the first run, defaults included."""
        with self.first().open() as run:
            found = run.parameters
        for part in key.split("."):
            found = found[part]
        return found

    def series(self, observer, quantity):
        """(time, value) of each run, see Run.series. Raises NothingThere if there is no run."""
        self.first()
        found = []
        for one in self.runs:
            with one.open() as run:
                found.append(run.series(observer, quantity))
        return found

    def estimate(self, observer, quantity, start, end=math.inf):
        """The Estimate over the runs of the mean over start < time <= end. Raises NothingThere without samples."""
        with self.first().open() as run:
            unit = run.time_unit
        means = [time_mean(time, value, start, end, unit=unit) for time, value in self.series(observer, quantity)]
        if not any(one.known for one in means):
            raise NothingThere(f"'{observer}.{quantity}' of {self.name} {means[0].problem}")
        return over_seeds([one.mean for one in means])

    def processor_seconds(self):
        """The Estimate over the runs of the processor time of a run, s."""
        return over_seeds([whole_cost(one)[1] for one in self.runs])

    def table_mean(self, observer, quantity, start):
        """The means of a table of constant size over the samples after `start`: one array (rows, columns) per run."""
        found = []
        for time, value in self.series(observer, quantity):
            inside = np.asarray(value, dtype=float)[np.asarray(time) > start]
            if len(inside):
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore", RuntimeWarning)  # the mean of cells that are always NaN is NaN
                    found.append(np.nanmean(inside, axis=0))
        return found


def whole_cost(finished):
    """(steps, s of processor time) of a Finished run."""
    with finished.open() as run:
        cost = run.cost
    return cost.steps, cost.cpu_seconds


class NothingThere(MesogenError):
    """Runs or samples that a section needs are missing."""


def _same(one, other):
    if isinstance(one, (int, float)) and isinstance(other, (int, float)):
        return math.isclose(one, other, rel_tol=1e-12)
    return one == other
