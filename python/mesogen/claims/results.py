"""The finished runs of a sweep, by point and seed."""

import math
import warnings
from dataclasses import dataclass, field

import numpy as np

from ..errors import MesogenError
from ..sweep.statistics import time_mean
from .estimate import over_seeds


@dataclass
class Results:
    """Runs of one sweep: sweep.Finished, in its order. missing: (label, reason) of those that there are not."""

    name: str
    runs: list
    missing: list = field(default_factory=list)

    def where(self, **conditions):
        """Those whose point has these values; dots of keys are written as two underscores:
        where(physics__activity__activity=0.023)."""
        wanted = {key.replace("__", "."): value for key, value in conditions.items()}
        name = self.name + "".join(f", {key} = {value}" for key, value in wanted.items())
        return Results(name, [one for one in self.runs
                              if all(_same(one.run.overrides.get(key), value) for key, value in wanted.items())])

    def points(self, key):
        """Values at a key, in the order of the sweep."""
        return list(dict.fromkeys(one.run.overrides[key] for one in self.runs if key in one.run.overrides))

    def first(self):
        """The first of them; raises NothingThere if there is none."""
        if not self.runs:
            raise NothingThere(f"there is no finished run of {self.name}")
        return self.runs[0]

    def value(self, key):
        """What the first of them has at a dotted key of its case."""
        with self.first().open() as run:
            found = run.parameters
        for part in key.split("."):
            found = found[part]
        return found

    def series(self, observer, quantity):
        """[(time, value)] of each run; raises NothingThere if there is none."""
        self.first()
        found = []
        for one in self.runs:
            with one.open() as run:
                found.append(run.series(observer, quantity))
        return found

    def estimate(self, observer, quantity, start, end=math.inf):
        """The Estimate over seeds of the mean over a span of time (s)."""
        return over_seeds([time_mean(time, value, start, end).mean for time, value in self.series(observer, quantity)])

    def table_mean(self, observer, quantity, start):
        """Tables of constant size averaged over the samples after `start` (s): one array (rows, columns) a run."""
        found = []
        for time, value in self.series(observer, quantity):
            inside = np.asarray(value, dtype=float)[np.asarray(time) > start]
            if len(inside):
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore", RuntimeWarning)  # of a cell that is never known the mean is NaN
                    found.append(np.nanmean(inside, axis=0))
        return found


class NothingThere(MesogenError):
    """A section lacks the runs that it needs."""


def _same(one, other):
    if isinstance(one, (int, float)) and isinstance(other, (int, float)):
        return math.isclose(one, other, rel_tol=1e-12)
    return one == other
