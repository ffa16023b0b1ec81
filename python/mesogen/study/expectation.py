"""How long runs will take, from those that are done."""

from statistics import median

GROWTH = 3.5  # time grows as this power of the resolution where nothing is known: N^2 particles, step ~ 1/N to 1/N^2


def expected_seconds(variant, resolution, known):
    """Expected time of a run (s), None if there is nothing to go by.

    known: {(variant, resolution): [s, ...]} of the runs that are done.
    The same point's own time; else that of the nearest resolution of the same variant, else of all, scaled.
    """
    own = known.get((variant, resolution))
    if own:
        return median(own)
    for candidates in ([key for key in known if key[0] == variant], list(known)):
        if candidates:
            nearest = min(candidates, key=lambda key: abs(key[1] / resolution - 1.0))[1]
            times = [second for key in candidates if key[1] == nearest for second in known[key]]
            return median(times) * (resolution / nearest) ** GROWTH
    return None


def expected_left(points, known):
    """Expected time of all these (variant, resolution), None if one of them is not known."""
    seconds = [expected_seconds(*point, known) for point in points]
    return None if None in seconds else sum(seconds)
