"""Speed against activity."""

import numpy as np

from mesogen.figures import style
from mesogen.study import above
from mesogen.study.verdict import all_of

TITLE = "Speed against activity"
FIGURE = "root mean square velocity against activity"
SWEEPS = ["activity"]


def write(section):
    runs = section.runs("activity")
    end = runs.value("time.end")
    values = sorted({abs(zeta) for zeta in runs.points("physics.activity.activity")})
    speeds = {sign: [runs.where(physics__activity__activity=sign * z).estimate("flow", "v_rms", 0.5 * end) for z in values]
              for sign in (1, -1)}
    page, (axes,) = style.tiles(1, 1, (4.4, 3.2))
    for sign, name, colour in ((1, "extensile, ζ > 0", style.SERIES[0]), (-1, "contractile, ζ < 0", style.SERIES[1])):
        axes.errorbar(values, [e.mean for e in speeds[sign]], [np.nan_to_num(e.error) for e in speeds[sign]], marker="o",
                      markersize=4, capsize=2, color=colour, label=name)
    axes.set_xlabel("|ζ| (Pa)")
    axes.set_ylabel("v rms (m/s)")
    axes.legend()
    rows = [(z, p.mean, p.error, m.mean, m.error) for z, p, m in zip(values, speeds[1], speeds[-1])]
    section.picture("v_rms", page, f"Means over the second half of {end:g} s, standard errors over seeds; box of "
                    f"{runs.value('domain.size')[0]:g} m.",
                    ("zeta", "extensile", "error", "contractile", "error_contractile"), rows)
    for sign, name in ((1, "extensile"), (-1, "contractile")):
        steps = [above(high, low) for low, high in zip(speeds[sign], speeds[sign][1:])]
        section.claim(f"The speed rises with the activity, {name}.", all_of(steps),
                      ", ".join(f"{e.text(2)} at {z:g}" for z, e in zip(values, speeds[sign])) + " m/s")
    pairs = [above(m, p) for p, m in zip(speeds[1], speeds[-1])]
    section.claim("Contractile fluids are faster than extensile ones at the same |ζ|.", all_of(pairs),
                  "; ".join(f"{z:g} Pa: {verdict}" for z, verdict in zip(values, pairs)))
