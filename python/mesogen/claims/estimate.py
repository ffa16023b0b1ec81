"""Means with standard errors, and what they decide."""

import math
from dataclasses import dataclass

import numpy as np

from ..sweep.statistics import standard_error
from .verdict import DOES_NOT_HOLD, HOLDS, NOT_RESOLVED

# A difference is taken as seen beyond so many of its standard errors. With three seeds the error itself is uncertain:
# Student's t says 2.8 for 5 % of two samples of three.
CLEAR = 2.8


@dataclass(frozen=True)
class Estimate:
    """A mean and its standard error, over `count` independent values; NaN for the error of one value."""

    mean: float
    error: float
    count: int

    def text(self, digits=3):
        """As "0.158 ± 0.002": the mean to so many significant digits, or as many as the error has."""
        if not math.isfinite(self.mean):
            return "none"
        size = math.floor(math.log10(abs(self.mean))) if self.mean else 0
        places = max(0, digits - 1 - size)
        if self.error > 0:  # of the error at least one
            places = max(places, -math.floor(math.log10(self.error)))
        error = f" ± {self.error:.{places}f}" if math.isfinite(self.error) else ""
        return f"{self.mean:.{places}f}{error}"


def over_seeds(values):
    """The Estimate of independent values; those that are not finite are left out."""
    known = np.asarray([value for value in values if math.isfinite(value)], dtype=float)
    if not len(known):
        return Estimate(math.nan, math.nan, 0)
    return Estimate(float(known.mean()), standard_error(known), len(known))


def distance(one, other):
    """How far one lies above the other, in standard errors of the difference; NaN if that is not known."""
    error = math.hypot(one.error, other.error)
    gap = one.mean - other.mean
    if not error > 0:
        return math.copysign(math.inf, gap) if error == 0 and gap != 0 else math.nan
    return gap / error


def above(one, other, clear=CLEAR):
    """The verdict on "one lies above the other"."""
    apart = distance(one, other)
    if math.isnan(apart) or abs(apart) < clear:
        return NOT_RESOLVED
    return HOLDS if apart > 0 else DOES_NOT_HOLD


def agrees(one, value, within, clear=CLEAR):
    """The verdict on "one is `value`, but for `within`": it holds if the mean lies inside and its error is small enough to
    say so, does not if it lies clearly outside."""
    off = abs(one.mean - value)
    error = one.error if math.isfinite(one.error) else math.inf
    if not math.isfinite(off):
        return NOT_RESOLVED
    if off <= within and error <= within:
        return HOLDS
    return DOES_NOT_HOLD if off - clear * error > within else NOT_RESOLVED


def slope(x, y):
    """Exponent p of y ~ x^p by least squares over the logarithms; x, y above 0. NaN below two points."""
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    known = (x > 0) & (y > 0) & np.isfinite(x) & np.isfinite(y)
    if known.sum() < 2:
        return math.nan
    return float(np.polyfit(np.log(x[known]), np.log(y[known]), 1)[0])
