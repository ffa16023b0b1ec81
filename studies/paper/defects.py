"""Director, defects and how they move."""

import numpy as np

from mesogen.figures import director, style
from mesogen.figures.scene import Scene
from mesogen.study import HOLDS, above
from mesogen.study.estimate import Estimate
from mesogen.study.verdict import DOES_NOT_HOLD, all_of

TITLE = "Director and topological defects"
FIGURE = "particle alignment and topological defects at ζ = ±0.023 Pa"
SWEEPS = ["turbulence"]


def write(section):
    runs = section.runs("turbulence")
    end = runs.value("time.end")
    page, axes = style.tiles(1, 2, (4.4, 4.4))
    rows, faster, created = [], [], []
    for place, zeta in zip(axes, (0.023, -0.023)):
        some = runs.where(physics__activity__activity=zeta)
        with some.first().open() as run:
            director.draw(place, Scene(run, -1), lines_across=60)
        place.set_title(f"ζ = {zeta:+g} Pa")
        start = 0.6 * end
        plus, minus = (some.estimate("tracks", f"speed_{sign}", start) for sign in ("plus", "minus"))
        along = some.estimate("tracks", "axial_velocity_plus", start)
        count = some.estimate("defects", "count_plus", start)
        rows.append((f"{zeta:+g}", count.text(), plus.text(), minus.text(), along.text()))
        faster.append(above(plus, minus))
        created.append((zeta, along))
    section.picture("director", page, "Director over the order q in the larger box; +1/2 as drops, -1/2 as stars.",
                    quality=88)
    section.table(("ζ, Pa", "+1/2 defects", "speed of +1/2, m/s", "speed of -1/2, m/s",
                   "+1/2 along its axis, toward the head, m/s"), rows)
    nothing = Estimate(0.0, 0.0, 1)
    section.claim("Defects of charge +1/2 move by themselves, those of -1/2 are carried along: they are faster.",
                  all_of(faster), "; ".join(f"ζ = {row[0]} Pa: {row[2]} against {row[3]} m/s" for row in rows))
    (_, extensile), (_, contractile) = created
    section.claim("An extensile +1/2 defect moves head first, a contractile one tail first.",
                  all_of([above(extensile, nothing), above(nothing, contractile)]),
                  f"along the axis toward the head {extensile.text()} and {contractile.text()} m/s",
                  "The paper says it of extensile ones; the other sign is what the same argument gives.")
    charges = [np.abs(value).max() for _, value in runs.series("defects", "total_charge")]
    section.claim("Charges sum to zero in a periodic box.", HOLDS if max(charges) == 0 else DOES_NOT_HOLD,
                  f"largest sum at any time: {max(charges):g}")
