"""The cost of a step, and the time of a solver on a grid over that of particles.

The runs of a study share their machine. So times are measured by themselves, by bench/speed.py and bench/rival.py; this
section reads their tables.
"""

import csv
import math
import pathlib

from mesogen.errors import MesogenError
from mesogen.figures import style
from mesogen.study import DOES_NOT_HOLD, HOLDS, NOT_RESOLVED, decided

TITLE = "Cost of a step, and of a grid"
FIGURE = "share of each part of a step; speed-up over a serial finite-volume solver against resolution"
SWEEPS = []

MEASURED = pathlib.Path(__file__).resolve().parents[2] / "docs" / "performance"
GRID = "finite volume (multigrid)"
FLOWS = (("WCSPH", style.SERIES[0]), ("incompressible", style.SERIES[1]))
MOST_ROWS = 8
# What the paper's first group of operations, 43.9 %, is here: copies beyond the faces, and who is near whom.
GHOSTS = "framework: values beyond the faces"
SORTING = "framework: neighbours, sorting"


def write(section):
    shares = {row["row"]: float(row["value"]) for row in _read("speed.csv")
              if row["table"] == "shares" and row["column"] == "%"}
    if GHOSTS not in shares or SORTING not in shares:
        raise MesogenError(f"{MEASURED / 'speed.csv'}: holds no shares of a step; bench/speed.py measures them")
    one = _times(_read("rival.csv"))
    two = _times(_read("rival_two_threads.csv"))
    section.text("Measured by bench/speed.py and bench/rival.py, not by the runs of this study: docs/performance.md and "
                 "docs/performance/rival.md name machine and compiler.")
    section.table(("part of a step of 250,000 particles", "% of its time"),
                  [(name, f"{share:.2g}") for name, share in sorted(shares.items(), key=lambda pair: -pair[1])[:MOST_ROWS]])
    section.claim("Making ghosts one after the other, with the search for neighbours, costs the most of a step: 43.9 %.",
                  decided(shares[GHOSTS] + shares[SORTING] >= max(share for name, share in shares.items()
                                                                  if name not in (GHOSTS, SORTING))),
                  f"{shares[GHOSTS]:.2g} % for values beyond the faces, {shares[SORTING]:.2g} % for neighbours",
                  "Ghosts are made in parallel, and kept with the lists of neighbours until a particle has moved half the skin.")
    _draw(section, one, two)
    for name, times, text in (("two cores", two, "Particles in parallel outrun a serial solver on a grid where resolution is high."),
                              ("one core", one, "Particles outrun a grid at equal resolution, one core against one.")):
        largest = max(across for across in times[GRID] if across in times["WCSPH"])
        ratios = {flow: times[GRID][largest][0] / times[flow][largest][0] for flow, _ in FLOWS}
        section.claim(text, HOLDS if min(ratios.values()) > 1 else DOES_NOT_HOLD if max(ratios.values()) < 1 else NOT_RESOLVED,
                      f"on {name} at {largest} x {largest} the grid takes " +
                      " and ".join(f"{ratio:.2g} of the time of {flow}" for flow, ratio in ratios.items()),
                      "A grid has no sound to resolve and four neighbours a cell. The paper's particles were on a GPU; here none "
                      "was at hand.")


def _read(name):
    try:
        with open(MEASURED / name, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))
    except OSError as error:
        raise MesogenError(f"{error.filename}: cannot be read; bench/speed.py and bench/rival.py write such tables") from error


def _times(rows):
    """{variant: {across: (seconds, error)}}; error NaN where the time is predicted."""
    times = {}
    for row in rows:
        times.setdefault(row["variant"], {})[int(row["across"])] = (float(row["seconds"]), float(row["error"] or math.nan))
    return times


def _draw(section, one, two):
    page, (left, right) = style.tiles(1, 2, (3.4, 3.0))
    for axes in (left, right):
        axes.set_xscale("log")
        axes.set_yscale("log")
    for times, line, cores in ((one, "o-", "one core"), (two, "s--", "two cores")):
        for flow, colour in FLOWS:
            pairs = [(across, times[GRID][across][0] / seconds) for across, (seconds, _) in sorted(times[flow].items())
                     if across in times[GRID]]
            left.plot(*zip(*pairs), line, markersize=3.5, color=colour, label=f"{flow}, {cores}")
    left.axhline(1.0, color=style.QUIET, linewidth=0.8)
    ticks = [across for across in sorted(one[GRID]) if math.log2(across).is_integer()]
    left.set_xticks(ticks, [str(across) for across in ticks])
    left.minorticks_off()
    left.set_xlabel("particles or cells across")
    left.set_ylabel("time of the grid / of particles")
    left.set_title("At equal resolution")
    for method, colour in (*FLOWS, (GRID, style.INK)):
        known = [(seconds, 100 * error) for seconds, error in one[method].values() if math.isfinite(error)]
        right.plot(*zip(*sorted(known)), "o-", markersize=3.5, color=colour, label=method)
    right.set_xlabel("processor time (s)")
    right.set_ylabel("error (%)")
    right.set_title("Error against cost")
    for axes in (left, right):
        axes.legend()
    rows = [(cores, variant, across, seconds, error) for cores, times in ((1, one), (2, two))
            for variant, row in times.items() for across, (seconds, error) in sorted(row.items())]
    section.picture("speed_up", page, "Particles beside a serial finite-volume solver (second order, multigrid) on the "
                    "deterministic benchmark to 40 s. Left: above the line particles are faster; the grid has one core, and WCSPH "
                    "from 128 across is predicted from its time a step. Right: on one core, with the error of v rms; for one error "
                    "the flow without sound is the cheapest, since its derivatives are those of Fourier series.",
                    ("cores", "method", "across", "seconds", "error"), rows)
