"""How far a run is from the known result: the one place where an error is defined.

Each quantity of an answer has a measure, which turns a recorded series into numbers. A number's error is
|number - exact| / scale, with scale = |exact| unless the answer gives one. The error of a run is the root mean square
of all these errors: 0.01 is 1 %.

A measure is an entry of MEASURES: `of(run, quantity)` gives the numbers, `count(at)` is how many they are. To add one,
add it there, and test it on a series with a known result (python/tests/test_charts_measures.py).
"""

from collections import namedtuple

import numpy as np

from ..errors import StudyError


class Vanished(StudyError):
    """The series has no such measure, for example no growth rate below 0: the run is wrong, not the answer."""


Measure = namedtuple("Measure", "of count doc")


def value(run, quantity):
    """The series at the times `at`."""
    time, series = _series(run, quantity)
    return [interpolate(time, series, at, run.time_unit) for at in quantity.at]


def growth_rate(run, quantity):
    """Slope of log(series) between the two times `at`, by least squares over the samples there (1/s)."""
    time, series = _series(run, quantity)
    first, last = quantity.at
    slack, unit = 1e-9 * max(abs(first), abs(last)), run.time_unit
    gap = slack + (np.diff(time).max() if len(time) > 1 else 0.0)  # samples need not lie at the ends
    if len(time) and (time[0] > first + gap or time[-1] < last - gap):
        raise StudyError(f"the answer is for t = {first:g} to {last:g} {unit}, but {_name(quantity)} was recorded "
                         f"from t = {time[0]:g} to {time[-1]:g} {unit}")
    chosen = (time >= first - slack) & (time <= last + slack)
    if chosen.sum() < 2:
        raise StudyError(f"{_name(quantity)} has {chosen.sum()} samples from t = {first:g} to {last:g} {unit}, and a growth "
                         "rate needs two: let the observer sample oftener")
    if not (series[chosen] > 0).all():
        raise Vanished(f"{_name(quantity)} is not above 0 from t = {first:g} to {last:g} {unit}: it has no growth rate")
    return [float(np.polyfit(time[chosen], np.log(series[chosen]), 1)[0])]


MEASURES = {
    "value": Measure(value, len, "the series at the times `at`"),
    "growth_rate": Measure(growth_rate, lambda at: 1, "the slope of its logarithm between two times"),
}


def error(run, quantities):
    """The relative error of a run, root mean square over all quantities: 0.01 is 1 %.

    run: mesogen.Run; quantities: of the answer. Raises MesogenError if one was not recorded.
    """
    errors = [
        (number - exact) / (quantity.scale or abs(exact))
        for quantity in quantities
        for number, exact in zip(MEASURES[quantity.measure].of(run, quantity), quantity.exact, strict=True)
    ]
    return float(np.sqrt(np.mean(np.square(errors))))


def interpolate(time, series, at, unit="s"):
    """The series at a time, by the cubic through the four samples around it (fewer where there are fewer).

    unit: of times, for messages. Raises StudyError beyond the ends of the series.
    """
    slack = 1e-6 * max(abs(at), 1e-300)
    if not len(time) or at < time[0] - slack or at > time[-1] + slack:
        span = f"from t = {time[0]:g} to {time[-1]:g} {unit}" if len(time) else "never"
        raise StudyError(f"the answer is for t = {at:g} {unit}, but the series was recorded {span}")
    nearest = int(np.argmin(np.abs(time - at)))
    if abs(time[nearest] - at) <= slack:
        return float(series[nearest])
    first = min(max(int(np.searchsorted(time, at)) - 2, 0), max(len(time) - 4, 0))
    x, y = time[first : first + 4], series[first : first + 4]
    weights = [np.prod([(at - b) / (a - b) for b in x if b != a]) for a in x]
    return float(np.dot(weights, y))


def _name(quantity):
    return f"{quantity.observer}.{quantity.column}"


def _series(run, quantity):
    time, series = run.series(quantity.observer, quantity.column)
    if series.ndim != 1:
        raise StudyError(f"{_name(quantity)} is a table, and an answer is about one number at a time")
    return time, series
