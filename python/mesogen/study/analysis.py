"""What a chart says of its points: who is best, how fast errors fall, what an error costs."""

import math
from dataclasses import dataclass

import numpy as np

LEVELS = (0.1, 0.03, 0.01, 0.003)  # relative errors of the table


def front(points):
    """The Pareto front: points that no other beats in both cost and error, by growing cost.

    points: those that did not fail. Of points equal in both, the first.
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
    """What a variant costs to stay within an error."""

    variant: str
    wall: float  # s
    between: tuple  # resolutions: (48,) measured there, (36, 48) interpolated between the two


def reach(points, level):
    """The cheapest way in which one variant stays within a relative error, None if it never does.

    points: of one variant. Cost is interpolated between two measured points that follow each other, in log error and
    log cost, never beyond them. Every finer point that did not fail must stay within the error as well: a coarse run
    that hits the answer by luck does not count.
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
    """{variant: [points by resolution]} in the order of their first appearance."""
    result = {}
    for point in points:
        result.setdefault(point.variant, []).append(point)
    return {variant: sorted(group, key=lambda p: p.resolution) for variant, group in result.items()}


def cheapest(points, level):
    """The Reach of the variant that costs least at this level, None if nobody stays within it."""
    found = [one for group in by_variant(points).values() if (one := reach(group, level))]
    return min(found, key=lambda one: one.wall, default=None)
