"""Mixing."""

import numpy as np

from mesogen.figures import style
from mesogen.study import above, over_seeds
from mesogen.study.verdict import all_of

TITLE = "Mixing"
FIGURE = "mixing at t = 45, 252, 500 s"
SWEEPS = ["small_box"]
ACTIVITIES = (0.023, -0.023, -0.25)
COLOURS = np.array(["#2a5c8a", "#e9b872", "#4f9a6a", "#c4553b"])


def quarters(run):
    """A colour for each particle, by the quarter of the box in which it began."""
    x, y = (run.field("position", 0) / run.box).T[:2] < 0.5
    return COLOURS[2 * x.astype(int) + y.astype(int)]


def write(section):
    times = (45.0, 252.0, 500.0)
    page, axes = style.tiles(3, 3, (2.6, 2.6))
    indices = {}
    for row, zeta in enumerate(ACTIVITIES):
        runs = section.runs("small_box").where(physics__activity__activity=zeta)
        with runs.first().open() as run:
            colours = quarters(run)
            for column, time in enumerate(times):
                frame = run.frame_at(time)
                place = axes[3 * row + column]
                position = run.field("position", frame)
                place.scatter(position[:, 0], position[:, 1], s=(2.6 * 72) ** 2 / len(position) * 1.1, c=colours,
                              marker="s", linewidths=0)
                style.box_axes(place, run.box)
                place.set_title(f"ζ = {zeta:+g} Pa, t = {run.times[frame]:.0f} s")
        indices[zeta] = [over_seeds([float(np.interp(time, t, v)) for t, v in runs.series("mixing", "mixing_index")])
                         for time in times]
    section.picture("quarters", page, "Particles coloured by the quarter in which they began.", quality=85)
    section.table(("ζ, Pa", *(f"mixing index at {t:g} s" for t in times)),
                  [(f"{zeta:+g}", *(e.text(2) for e in found)) for zeta, found in indices.items()])
    section.claim("The stronger the activity, the faster it mixes.",
                  all_of([above(indices[-0.25][n], indices[-0.023][n]) for n in (1, 2)]),
                  "; ".join(f"at {times[n]:g} s {indices[-0.25][n].text(2)} against {indices[-0.023][n].text(2)}" for n in (1, 2)))
    section.claim("Contractile fluids mix better than extensile ones.", above(indices[-0.023][2], indices[0.023][2]),
                  f"mixing index at 500 s {indices[-0.023][2].text(2)} against {indices[0.023][2].text(2)}",
                  "In a box of 10 m at |ζ| = 0.023 Pa the contractile instability needs most of the time to grow.")
