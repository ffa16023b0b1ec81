"""Autocorrelation of velocity and vorticity."""

import math

import numpy as np

from mesogen.figures import style
from mesogen.study import DOES_NOT_HOLD, HOLDS, NOT_RESOLVED, agrees, ratio

TITLE = "Correlations and length scales"
FIGURE = "vorticity-vorticity correlation"
SWEEPS = ["turbulence", "flows"]


def write(section):
    page, axes = style.tiles(1, 2, (3.6, 2.9))
    rows = []
    turbulence = section.runs("turbulence")
    end = turbulence.value("time.end")
    box = turbulence.value("domain.size")[0]
    tails = []
    for colour, zeta in zip(style.SERIES, (0.023, -0.023)):
        for mark, quantity in (("-", "vorticity"), ("--", "velocity")):
            found = turbulence.where(physics__activity__activity=zeta).table_mean("correlation", quantity, 0.6 * end)
            mean = np.mean(found, axis=0)
            axes[0].plot(mean[:, 0], mean[:, 2], mark, color=colour, label=f"{quantity}, ζ = {zeta:+g} Pa")
            rows += [(f"{quantity} {zeta:+g}", float(r), float(c)) for r, c in mean[:, [0, 2]]]
            if quantity == "vorticity":
                tails.append(float(np.abs(mean[mean[:, 0] > 0.35 * box, 2]).max()))
    flows = section.runs("flows")
    for colour, flow in zip(style.SERIES[2:], ("incompressible", "wcsph")):
        found = flows.where(physics__flow__type=flow).table_mean("correlation", "vorticity", 0.5 * flows.value("time.end"))
        mean = np.mean(found, axis=0)
        axes[1].plot(mean[:, 0], mean[:, 1], color=colour, label=flow)
        rows += [(f"vorticity {flow}", float(r), float(c)) for r, c in mean[:, [0, 1]]]
    titles = (f"Table 2, box of {box:g} m, all directions", "0.03 Pa, 0.1 Pa s, box of 10 m, along the axes")
    for place, title in zip(axes, titles):
        place.axhline(0.0, color=style.QUIET, linewidth=0.6)
        place.set_xlabel("distance (m)")
        place.set_ylabel("correlation")
        place.set_title(title)
        place.legend()
    section.picture("correlation", page, "Averaged over the box and over time: left, both signs of the activity; right, by "
                    "both flows.", ("curve", "r", "C"), rows)
    verdict = HOLDS if tails and max(tails) < 0.05 else DOES_NOT_HOLD if tails and max(tails) > 0.2 else NOT_RESOLVED
    section.claim("Far from each other vorticities are not correlated.", verdict,
                  f"|C| is at most {max(tails, default=math.nan):.3f} beyond 0.35 of the box",
                  "One point's neighbours along one line, as in the paper, say little: here all points are averaged over.")
    _flows(section)


def _flows(section):
    runs = section.runs("flows")
    one, other = (runs.where(physics__flow__type=flow).estimate("correlation", "vorticity_level_axes",
                                                                0.5 * runs.value("time.end"))
                  for flow in ("incompressible", "wcsph"))
    section.claim("SPH and a grid give the same correlation of the vorticity.", agrees(ratio(other, one), 1.0, 0.05),
                  f"C = 0.2 at {other.text()} m by weakly compressible SPH, {one.text()} m by the flow on a mesh; a "
                  "pseudo-spectral solver says 1.15 ± 0.04 m")

