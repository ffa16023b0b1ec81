"""Means with standard errors, and verdicts from them."""

import math
from dataclasses import dataclass

import numpy as np

from ..runs.statistics import standard_error
from .verdict import DOES_NOT_HOLD, HOLDS, NOT_RESOLVED

# Student's t for a two-sided 95 % interval, for 1 to 10 degrees of freedom and for infinitely many: the error from a
# few seeds is itself uncertain.
STUDENT = (12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228)
NORMAL = 1.960


@dataclass(frozen=True)
class Estimate:
    """A mean and its standard error, of `count` independent values. error: NaN for one value, 0 for an exact number.

    For a combination of Estimates, count is one more than its degrees of freedom.
    """

    mean: float
    error: float
    count: float

    @property
    def uncertainty(self):
        """Half the width of the 95 % interval; NaN if it is unknown."""
        if not self.error > 0:
            return self.error
        return student(self.count - 1) * self.error

    def text(self, digits=3):
        """As "0.158 ± 0.002". digits: significant digits of the mean; more if the error needs them."""
        if not math.isfinite(self.mean):
            return "none"
        size = math.floor(math.log10(abs(self.mean))) if self.mean else 0
        places = fewest = max(0, digits - 1 - size)
        if self.error > 0:  # at least one digit of the error
            places = min(max(places, -math.floor(math.log10(self.error))), fewest + digits)
        error = f" ± {self.error:.{places}f}" if math.isfinite(self.error) else ""
        return f"{self.mean:.{places}f}{error}"


def student(freedom):
    """Student's t for a two-sided 95 % interval; NaN below one degree of freedom."""
    if not freedom >= 1:
        return math.nan
    known = [1 / n for n in range(len(STUDENT), 0, -1)]
    return float(np.interp(1 / freedom, [0.0, *known], [NORMAL, *reversed(STUDENT)]))


def over_seeds(values):
    """The Estimate of independent values, without those that are not finite."""
    known = np.asarray([value for value in values if math.isfinite(value)], dtype=float)
    if not len(known):
        return Estimate(math.nan, math.nan, 0)
    return Estimate(float(known.mean()), standard_error(known), len(known))


def combined(mean, *parts):
    """The Estimate of a combination. parts: (error that comes from one part, count of that part). The degrees of
    freedom are those of Welch and Satterthwaite."""
    error = math.hypot(*(error for error, _ in parts))
    terms = [error**4 / (count - 1) if count > 1 else math.nan for error, count in parts if error != 0]
    freedom = error**4 / sum(terms) if terms and sum(terms) > 0 else 0
    return Estimate(mean, error, freedom + 1)


def difference(one, other):
    """one - other."""
    return combined(one.mean - other.mean, (one.error, one.count), (other.error, other.count))


def ratio(one, other):
    """one / other."""
    value = one.mean / other.mean
    return combined(value, *((abs(value * part.error / part.mean), part.count) for part in (one, other)))


def above(one, other):
    """The verdict on "one lies above the other": whether 0 lies outside the 95 % interval of the difference."""
    apart = difference(one, other)
    if not (math.isfinite(apart.mean) and abs(apart.mean) > apart.uncertainty):
        return NOT_RESOLVED
    return HOLDS if apart.mean > 0 else DOES_NOT_HOLD


def agrees(one, value, within):
    """The verdict on "one differs from `value` by at most `within`": it holds if the 95 % interval lies inside, and
    does not hold if it lies outside."""
    off = abs(one.mean - value)
    if off + one.uncertainty <= within:
        return HOLDS
    return DOES_NOT_HOLD if off - one.uncertainty > within else NOT_RESOLVED


def decided(holds, *numbers):
    """The verdict on a condition on some numbers: not resolved if one of them is not finite."""
    if not all(math.isfinite(number) for number in numbers):
        return NOT_RESOLVED
    return HOLDS if holds else DOES_NOT_HOLD


def exponent(x, estimates):
    """The Estimate of p in y ~ x^p, by least squares over the logarithms. estimates: of y at each x, all above 0.

    Raises ValueError for fewer than two points.
    """
    if len(x) < 2:
        raise ValueError("an exponent needs two points or more")
    log = np.log(np.asarray(x, dtype=float))
    weight = (log - log.mean()) / ((log - log.mean()) ** 2).sum()  # p = sum of weight ln y
    mean = float(weight @ np.log([one.mean for one in estimates]))
    return combined(mean, *((float(abs(w) * one.error / one.mean), one.count) for w, one in zip(weight, estimates)))
