"""The spectrum of the kinetic energy."""

import numpy as np

from mesogen.figures import style
from mesogen.study import agrees, over_seeds, ratio
from mesogen.study.verdict import all_of

TITLE = "Spectrum of the kinetic energy"
FIGURE = "spectrum of the kinetic energy for different particle resolutions"
SWEEPS = ["turbulence", "resolution"]
LARGE = 0.8  # 1/m: waves below are of large scales


def write(section):
    turbulence = section.runs("turbulence").where(physics__activity__activity=0.023)
    start = 0.6 * turbulence.value("time.end")
    others = section.runs("resolution")
    groups = {turbulence.value("particles.spacing"): turbulence}
    groups |= {spacing: others.where(particles__spacing=spacing) for spacing in others.points("particles.spacing")}
    groups = dict(sorted(groups.items()))
    spectra = {spacing: runs.table_mean("spectrum", "spectrum", start) for spacing, runs in groups.items()}
    slopes = {spacing: runs.table_mean("spectrum", "slopes", start) for spacing, runs in groups.items()}
    _draw(section, spectra, turbulence.value("domain.size")[0])
    ranges = next(iter(slopes.values()))[0][:, :2]
    section.table(("spacing, m", *(f"slope from {low:g} to {high:g} 1/m" for low, high in ranges)),
                  [(f"{spacing:g}", *(over_seeds([t[n, 2] for t in tables]).text() for n in range(len(ranges))))
                   for spacing, tables in slopes.items()])
    finest = next(iter(groups))
    middle = over_seeds([table[1, 2] for table in slopes[finest]])
    section.claim("At intermediate scales E(k) falls as the power -4 of the wave number.", agrees(middle, -4.0, 0.3),
                  f"slope {middle.text()} between {ranges[1][0]:g} and {ranges[1][1]:g} 1/m; asked for within 0.3",
                  "The spectrum bends all the way, so the slope is that of the range: -4 is met where the fall begins.")
    _large_scales(section, spectra)


def _draw(section, spectra, box):
    page, (axes,) = style.tiles(1, 1, (4.6, 3.4))
    rows = []
    for colour, (spacing, tables) in zip(style.SERIES, spectra.items()):
        mean = np.mean(tables, axis=0)
        axes.loglog(mean[:, 0], mean[:, 1], color=colour, label=f"spacing {spacing:g} m, {len(tables)} seeds")
        rows += [(spacing, float(k), float(energy)) for k, energy, *_ in mean]
    wave, energy = next((k, e) for _, k, e in rows if k > 1.0)
    line = np.array([0.6, 3.0])
    axes.loglog(line, 1.5 * energy * (line / wave) ** -4.0, "--", color=style.QUIET, label="$k^{-4}$")
    axes.set_xlabel("wave number k (1/m)")
    axes.set_ylabel("E(k) (m³/s²)")
    axes.legend()
    section.picture("spectrum", page, f"Energy by wave number at Table 2, ζ = 0.023 Pa, in a box of {box:g} m.",
                    ("spacing", "k", "E"), rows)


def _large_scales(section, spectra):
    energies = {spacing: over_seeds([table[table[:, 0] <= LARGE, 1].sum() for table in tables])
                for spacing, tables in spectra.items()}
    finest, *others = energies.values()
    ratios = [ratio(one, finest) for one in others]
    section.claim("At large scales the spectrum is the same for all resolutions.",
                  all_of(agrees(one, 1.0, 0.1) for one in ratios),
                  f"energy below {LARGE:g} 1/m, over that of the finest: {', '.join(one.text(2) for one in ratios)}; "
                  "asked for within 10 %")
