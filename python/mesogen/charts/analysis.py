"""Analysis of the points of a chart: the Pareto front, the order of convergence, the cost of an error."""

import math
from dataclasses import dataclass

import numpy as np

LEVELS = (0.1, 0.03, 0.01, 0.003)  # relative errors of the table


def front(points):
    """The Pareto front, by growing cost: points for which no other point has less cost and less error.

    points: without failed ones. Of points with the same cost and error, the first.
    """
    best, result = math.inf, []
    for point in sorted(points, key=lambda p: (p.wall, p.error)):
        if point.error < best:
            best = point.error
            result.append(point)
    return result


def order(points):
    """Order p of convergence, error ~ N^-p, by least squares over the logarithms; NaN below two resolutions."""
    known = [(p.resolution, p.error) for p in points if not p.failed and p.error > 0]
    if len({resolution for resolution, _ in known}) < 2:
        return math.nan
    slope, _ = np.polyfit(*np.log(np.array(known, dtype=float)).T, 1)
    return float(-slope)


@dataclass(frozen=True)
class Reach:
    """The cost at which a variant stays within an error."""

    variant: str
    wall: float  # s
    between: tuple  # (48,): measured at this resolution; (36, 48): interpolated between these


def reach(points, level):
    """The cheapest Reach of one variant to stay within a relative error, None if it never does.

    points: of one variant. Cost is interpolated between two neighbouring measured points, in log error and log cost,
    never beyond them. Every finer point that did not fail must also be within the error: a coarse run that hits the
    answer by luck does not count.
    """
    good = sorted((p for p in points if not p.failed), key=lambda p: p.resolution)
    held = len(good)
    while held > 0 and good[held - 1].error <= level:
        held -= 1
    if held == len(good):
        return None
    inside = good[held]
    found = min(good[held:], key=lambda p: p.wall)
    measured = Reach(found.variant, found.wall, (found.resolution,))
    if held == 0 or inside.error == level or not inside.error > 0:
        return measured
    outside = good[held - 1]
    share = math.log(level / outside.error) / math.log(inside.error / outside.error)
    wall = math.exp((1 - share) * math.log(outside.wall) + share * math.log(inside.wall))
    return measured if measured.wall <= wall else Reach(inside.variant, wall, (outside.resolution, inside.resolution))


def by_variant(points):
    """{variant: [points by resolution]}, in the order of the first appearance of the variants."""
    result = {}
    for point in points:
        result.setdefault(point.variant, []).append(point)
    return {variant: sorted(group, key=lambda p: p.resolution) for variant, group in result.items()}


def cheapest(points, level):
    """The cheapest Reach of all variants at a relative error, None if none stays within it."""
    found = [one for group in by_variant(points).values() if (one := reach(group, level))]
    return min(found, key=lambda one: one.wall, default=None)
