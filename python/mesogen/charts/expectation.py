"""How long runs will take, expected from finished runs."""

from statistics import median

GROWTH = 3.5  # assumed power of the resolution: N^2 particles, and steps of 1/N to 1/N^2


def expected_seconds(variant, resolution, known):
    """Expected time of a run (s), None if no run is known.

    known: {(variant, resolution): [s, ...]} of finished runs.
    That of the same point; else that of the nearest resolution of the same variant, else of any variant, scaled.
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
    """Expected time of all these (variant, resolution) together (s), None if one of them is unknown."""
    seconds = [expected_seconds(*point, known) for point in points]
    return None if None in seconds else sum(seconds)
