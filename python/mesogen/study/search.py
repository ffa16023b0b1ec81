"""Where something changes from holding to failing, by bisection, with as few trials as that takes.

Nothing is taken for granted: all points of a first grid are tried, both ends among them, and every pair of neighbours
that differ is narrowed down. Several boundaries are found where the grid shows them.
"""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Sweep:
    """A range of one parameter. `tolerance`: how far inside and outside may be apart, as a ratio minus 1 (log) or as a
    difference."""

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
        """Whether two values (low < high) are near enough."""
        return high / low - 1.0 <= self.tolerance if self.log else high - low <= self.tolerance

    def middle(self, low, high):
        """A short number about half way; low < middle < high."""
        exact = math.sqrt(low * high) if self.log else 0.5 * (low + high)
        short = rounded(exact)
        return short if low < short < high else exact

    def most_trials(self):
        """How many trials one boundary takes at most."""
        span = abs(math.log(self.last / self.first)) if self.log else abs(self.last - self.first)
        unit = math.log1p(self.tolerance) if self.log else self.tolerance
        return self.points + max(0, math.ceil(math.log2(span / (self.points - 1) / unit)))


def rounded(value):
    """Four significant digits: a value that is short on a command line."""
    return float(f"{value:.4g}")


def next_value(sweep, holds):
    """The value to try next, None when all is known. holds: {value: whether it held} of those tried."""
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
