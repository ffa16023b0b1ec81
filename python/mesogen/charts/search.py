"""Search for the values of a parameter at which runs begin to fail, by bisection.

All points of a first grid are tried, including both ends; each pair of neighbours that differ is then narrowed down. So
several boundaries can be found.
"""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Sweep:
    """A range of one parameter. tolerance: largest distance between the last value that holds and the first that fails,
    as a ratio minus 1 (log) or as a difference. points: of the first grid."""

    first: float
    last: float
    log: bool
    tolerance: float
    points: int = 2

    def grid(self):
        """The values that are tried first, evenly spaced from `first` to `last`."""
        shares = [i / (self.points - 1) for i in range(self.points)]
        if self.log:
            inner = [self.first * (self.last / self.first) ** share for share in shares[1:-1]]
        else:
            inner = [self.first + (self.last - self.first) * share for share in shares[1:-1]]
        return [self.first, *(rounded(value) for value in inner), self.last]

    def narrow(self, low, high):
        """Whether two values (low < high) are within the tolerance."""
        return high / low - 1.0 <= self.tolerance if self.log else high - low <= self.tolerance

    def middle(self, low, high):
        """A number with few digits about half way; low < middle < high."""
        exact = math.sqrt(low * high) if self.log else 0.5 * (low + high)
        short = rounded(exact)
        return short if low < short < high else exact

    def most_trials(self):
        """Largest number of trials for one boundary."""
        span = abs(math.log(self.last / self.first)) if self.log else abs(self.last - self.first)
        unit = math.log1p(self.tolerance) if self.log else self.tolerance
        return self.points + max(0, math.ceil(math.log2(span / (self.points - 1) / unit)))


def rounded(value):
    """The value with four significant digits, short on a command line."""
    return float(f"{value:.4g}")


def next_value(sweep, holds):
    """The value to try next, None at the end of the search. holds: {tried value: whether it held}."""
    for value in sweep.grid():
        if value not in holds:
            return value
    return next((sweep.middle(low, high) for low, high in _changes(holds) if not sweep.narrow(low, high)), None)


def boundaries(holds):
    """[(inside, outside)] by growing value: neighbouring values of which the first held and the second did not."""
    return [(low, high) if holds[low] else (high, low) for low, high in _changes(holds)]


def _changes(holds):
    values = sorted(holds)
    return [(low, high) for low, high in zip(values, values[1:]) if holds[low] != holds[high]]
