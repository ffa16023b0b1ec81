"""Means of a series over time, and their errors.

Samples close in time are correlated, so that deviation / sqrt(samples) is too small an error. Here the span is cut into
blocks, and the error is the standard error of the blocks' means (Flyvbjerg and Petersen, J. Chem. Phys. 91, 461, 1989);
it is right if a block is many correlation times long. The correlation time is the integral of the autocorrelation,
summed up to a window of WINDOW correlation times (Sokal, in Functional Integration, 1997). By default a block is LONG
correlation times long.
"""

import math
from dataclasses import dataclass

import numpy as np

WINDOW = 5.0  # length of the sum over the autocorrelation, in correlation times
LONG = 10.0  # default length of a block, in correlation times: the error is then some 5 % too small
SHORT = 5.0  # shortest block without a warning, in correlation times: the error is then 10 % too small
FEWEST, MOST = 4, 32  # default numbers of blocks


@dataclass(frozen=True)
class Mean:
    """Of one run: mean and error in the unit of the series, correlation time in that of times. NaN: unknown."""

    mean: float
    error: float
    blocks: int
    correlation_time: float
    problem: str = ""  # a warning for the user, "" if there is none

    @property
    def known(self):
        return math.isfinite(self.mean)


def time_mean(time, value, start, end, blocks=None, unit="s"):
    """The Mean of the samples with start < time <= end.

    time, value: shape (T,). blocks: their number, None: chosen from the correlation time. unit: of times, for warnings.
    """
    time, value = np.asarray(time, dtype=float), np.asarray(value, dtype=float)
    inside = (time > start) & (time <= end)
    if not inside.any():
        last = f"; the last is at {time[-1]:g} {unit}" if len(time) else ""
        return Mean(math.nan, math.nan, 0, math.nan, f"has no sample after {start:g} {unit}{_until(end, unit)}{last}")
    good = inside & np.isfinite(value)
    if not good.any():
        return Mean(math.nan, math.nan, 0, math.nan, "is not a number in any sample")
    lost = int(inside.sum() - good.sum())
    problem = f"is not a number in {lost} of {int(inside.sum())} samples, which are left out" if lost else ""
    time, value = time[good], value[good]
    interval = (time[-1] - time[0]) / (len(time) - 1) if len(time) > 1 else math.nan
    correlation = correlation_samples(value)
    count = blocks or _block_count(len(value), correlation)
    if len(value) < 2 * count:
        few = f"has {len(value)} samples, too few for {count} blocks"
        return Mean(float(value.mean()), math.nan, 0, correlation * interval, "; ".join(filter(None, (problem, few))))
    error = block_error(value, count)
    if correlation > 0.5 and len(value) / count < SHORT * correlation:
        times = len(value) / count / correlation
        short = (f"changes so slowly that {count} blocks are {times:.1f} correlation times each: the error by blocks is "
                 "too small")
        problem = "; ".join(filter(None, (problem, short)))
    return Mean(float(value.mean()), error, count, correlation * interval, problem)


def block_error(value, blocks):
    """Standard error of the mean, from the means of `blocks` blocks of equal length."""
    means = np.array([part.mean() for part in np.array_split(np.asarray(value, dtype=float), blocks)])
    return float(means.std(ddof=1) / math.sqrt(blocks))


def correlation_samples(value):
    """The integral correlation time in samples: 1/2 + sum of the autocorrelation. 1/2: uncorrelated, or constant."""
    value = np.asarray(value, dtype=float)
    value = value - value.mean()
    count = len(value)
    variance = float(value @ value) / count
    if count < 2 or not variance > 1e-300:
        return 0.5
    spectrum = np.fft.rfft(value, 2 * count)
    correlation = np.fft.irfft(np.abs(spectrum) ** 2)[:count] / count / variance
    total = 0.5
    for lag in range(1, count):
        total += float(correlation[lag])
        if lag >= WINDOW * total:
            break
    return max(0.5, total)


def standard_error(values):
    """Standard error of the mean of independent values; NaN for fewer than two."""
    return float(np.std(values, ddof=1) / math.sqrt(len(values))) if len(values) > 1 else math.nan


def _block_count(samples, correlation):
    return min(MOST, max(FEWEST, int(samples / (LONG * correlation))))


def _until(end, unit):
    return f" up to {end:g} {unit}" if math.isfinite(end) else ""
