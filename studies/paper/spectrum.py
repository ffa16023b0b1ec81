"""The spectrum of the kinetic energy."""

import numpy as np

from mesogen.claims import agrees, over_seeds
from mesogen.claims.estimate import slope
from mesogen.figures import style

TITLE = "Spectrum of the kinetic energy"
FIGURE = "spectrum of the kinetic energy for different particle resolutions"
SWEEPS = ["turbulence", "resolution"]
RANGES = ((0.3, 0.8, "large scales"), (1.0, 3.0, "intermediate scales"), (3.0, 8.0, "small scales"))  # 1/m


def spectra(runs, start):
    return [table for table in runs.table_mean("spectrum", "spectrum", start)]


def write(section):
    turbulence = section.runs("turbulence").where(physics__activity__activity=0.023)
    end = turbulence.value("time.end")
    groups = [(turbulence, turbulence.value("particles.spacing"))]
    groups += [(section.runs("resolution").where(particles__spacing=spacing), spacing)
               for spacing in section.runs("resolution").points("particles.spacing")]
    groups.sort(key=lambda group: group[1])
    page, (axes,) = style.tiles(1, 1, (4.6, 3.4))
    rows, slopes, large = [], {}, {}
    for colour, (runs, spacing) in zip(style.SERIES, groups):
        found = spectra(runs, 0.6 * end)
        if not found:
            continue
        mean = np.mean(found, axis=0)
        axes.loglog(mean[:, 0], mean[:, 1], color=colour, label=f"spacing {spacing:g} m, {len(found)} seeds")
        rows += [(spacing, float(k), float(e)) for k, e, *_ in mean]
        for low, high, name in RANGES:
            inside = [(t[:, 0] >= low) & (t[:, 0] <= high) for t in found]
            slopes[spacing, name] = over_seeds([slope(t[i, 0], t[i, 1]) for t, i in zip(found, inside)])
        large[spacing] = over_seeds([t[t[:, 0] <= 0.8, 1].sum() for t in found])
    k = np.array([0.6, 3.0])
    axes.loglog(k, rows[3][2] * (k / rows[3][1]) ** -4.0, "--", color=style.QUIET, label="$k^{-4}$")
    axes.set_xlabel("wave number k (1/m)")
    axes.set_ylabel("E(k) (m³/s²)")
    axes.legend()
    section.picture("spectrum", page, "Energy by wave number at Table 2, ζ = 0.023 Pa: box of "
                    f"{turbulence.value('domain.size')[0]:g} m.", ("spacing", "k", "E"), rows)
    section.table(("spacing, m", *(f"slope at {name}, {low:g} to {high:g} 1/m" for low, high, name in RANGES)),
                  [(f"{spacing:g}", *(slopes[spacing, name].text() for *_, name in RANGES)) for _, spacing in groups
                   if (spacing, RANGES[0][2]) in slopes])
    finest = groups[0][1]
    middle = slopes[finest, "intermediate scales"]
    section.claim("At intermediate scales E(k) falls as the power -4 of the wave number.", agrees(middle, -4.0, 0.3),
                  f"slope {middle.text()} between 1 and 3 1/m",
                  "Asked for within 0.3. The slope depends on the range: the spectrum bends.")
    apart = [abs(one.mean / large[finest].mean - 1.0) for spacing, one in large.items() if spacing != finest]
    errors = [np.hypot(one.error / one.mean, large[finest].error / large[finest].mean) for spacing, one in large.items()
              if spacing != finest]
    if apart:
        from mesogen.claims import DOES_NOT_HOLD, HOLDS
        same = all(a <= max(0.1, 2.8 * e) for a, e in zip(apart, errors))
        section.claim("At large scales the spectrum is the same for all resolutions.", HOLDS if same else DOES_NOT_HOLD,
                      f"energy below 0.8 1/m differs by {100 * max(apart):.0f} % at most, standard error of the difference "
                      f"{100 * max(errors):.0f} %")
