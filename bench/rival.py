#!/usr/bin/python3
"""Particles against a grid: both flows of Mesogen and a serial finite-volume solver on the deterministic benchmark.

    bench/rival.py [--build build/release] [--across 16,24,32,48,64,96] [--large 128,192,256,512] [--threads 1]
                   [--repeats 3] [--charts docs/performance/rival] [-o TABLE.md] [--quick]

Runs cases/accuracy/benchmark to 40 s at each resolution. Error: of v_rms at 20, 30, 40 s, root mean square, relative.
Cost: processor time of stepping, s; with more threads the wall time of Mesogen's, beside the one core of the grid.
Explicit steps at the large resolutions are not run: their cost is what `mesogen check` measures a step times the
steps. Writes CHARTS.csv and CHARTS.png, prints the table. The build needs the benchmarks (scripts/setup all), or give
the program: --finite-volume. Some 8 minutes on a free core; --quick, ten seconds, shows whether all works.
"""

import argparse
import csv
import json
import math
import os
import pathlib
import statistics
import tempfile
import textwrap
from dataclasses import dataclass

from speed_runs import PROJECT, call, instruction_set, tell

import mesogen as results
from mesogen.charts.analysis import order, reach
from mesogen.charts.drawing import look
from mesogen.charts.measures import interpolate
from mesogen.charts.points import Point
from mesogen.charts.tables import percent
from mesogen.figures import style
from mesogen.runs.markdown import table_lines
from mesogen.runs.program import machine_text, version_text

CASE = PROJECT / "cases" / "accuracy" / "benchmark" / "case.toml"
LENGTH, END = 10.0, 40.0  # m, s
V_RMS = {20.0: 0.0237170, 30.0: 0.0462153, 40.0: 0.0756664}  # m/s, of cases/accuracy/benchmark/answer.toml
LONG = 20.0  # s: a run that takes as long is not repeated

WCSPH, EXPLICIT = ["physics.flow.type=wcsph"], "WCSPH, explicit steps"
FLOWS = {"WCSPH": WCSPH, EXPLICIT: [*WCSPH, "time.stepping=explicit"],
         "incompressible": ["physics.flow.type=incompressible"]}
# Euler's steps are a tenth of the stable ones, so that their error is no more than that of 64 cells.
GRIDS = {"finite volume (multigrid)": ["--pressure", "multigrid"],
         "finite volume (FFT)": ["--pressure", "fft"],
         "finite volume (Euler)": ["--pressure", "multigrid", "--time_scheme", "euler", "--factor", "0.1"]}
RIVAL, SMALL_ONLY = "finite volume (multigrid)", "finite volume (Euler)"


@dataclass(frozen=True)
class Result:
    """One variant at one resolution; error NaN where it was not run, shares NaN for particles."""

    variant: str
    across: int
    seconds: float
    steps: int
    error: float = math.nan
    pressure: float = math.nan   # share of the pressure solve
    diffusion: float = math.nan  # share of implicit diffusion
    source: str = "run"          # or "check": predicted by `mesogen check`


def relative_error(v_rms):
    """v_rms: {time: m/s}, of the times of V_RMS."""
    return math.sqrt(statistics.fmean((v_rms[time] / exact - 1.0) ** 2 for time, exact in V_RMS.items()))


def run_grid(program, variant, across):
    with tempfile.TemporaryDirectory(prefix="mesogen-") as folder:
        text = call([program, "--cells", across, "--end", END, "--csv", *GRIDS[variant]], folder)
    table = [{name: float(x) for name, x in row.items()} for row in csv.DictReader(text.splitlines())]
    rows = {row["time"]: row for row in table}
    cost = rows[END]
    return Result(variant, across, cost["processor_seconds"], int(cost["steps"]),
                  relative_error({time: row["v_rms"] for time, row in rows.items()}),
                  cost["pressure_share"], cost["diffusion_share"])


def settings(variant, across):
    """Words of the command."""
    changes = [*FLOWS[variant], f"particles.spacing={LENGTH / across!r}", f"time.end={END}"]
    return [word for one in changes for word in ("--set", one)]


def run_flow(mesogen, variant, across, threads):
    with tempfile.TemporaryDirectory(prefix="mesogen-") as folder:
        call([mesogen, "run", CASE, "--quiet", "--threads", threads, "--output", os.path.join(folder, "run"),
              *settings(variant, across)], folder)
        with results.open(os.path.join(folder, "run")) as run:
            times, values = run.series("flow", "v_rms")
            cost = run.cost
    # Processor time holds the start-up, wall time of one thread what else ran: stepping took no more than either.
    seconds = min(cost.wall_seconds, cost.cpu_seconds) if threads == 1 else cost.wall_seconds
    error = relative_error({time: interpolate(times, values, time) for time in V_RMS})
    return Result(variant, across, seconds, int(cost.steps), error)


def check_flow(mesogen, variant, across, threads):
    with tempfile.TemporaryDirectory(prefix="mesogen-") as folder:
        told = json.loads(call([mesogen, "check", CASE, "--json", "--threads", threads, *settings(variant, across)],
                               folder))
    steps = told["steps"]["steps_at_least"]
    return Result(variant, across, told["time"]["step"] * steps, steps, source="check")


def median_of(measure, repeats):
    """The result of the median time of some runs; of the first alone if that is long."""
    found = [measure()]
    while len(found) < repeats and found[0].seconds < LONG:
        found.append(measure())
    return sorted(found, key=lambda one: one.seconds)[(len(found) - 1) // 2]


def measure(options, program):
    mesogen = options.build / "bin" / "mesogen"
    found = []
    for across in options.across + options.large:
        for variant in [*FLOWS, *GRIDS]:
            if across in options.large and variant == SMALL_ONLY:
                continue
            tell(f"{variant}, {across} x {across}")
            if variant in GRIDS:
                found.append(median_of(lambda: run_grid(program, variant, across), options.repeats))
            elif across in options.large and variant == EXPLICIT:
                found.append(median_of(lambda: check_flow(mesogen, variant, across, options.threads), 1))
            else:
                found.append(median_of(lambda: run_flow(mesogen, variant, across, options.threads), options.repeats))
    return found


def points(found, variant):
    """As the study's tools take them: those that were run."""
    return [Point(r.variant, r.across, r.error, r.seconds, r.seconds, r.seconds, r.seconds, r.steps, math.nan, 1)
            for r in found if r.variant == variant and r.source == "run"]


def at_equal_resolution(found, flow):
    """{across: cost of the grid over that of the flow}."""
    rival = {r.across: r.seconds for r in found if r.variant == RIVAL}
    return {r.across: rival[r.across] / r.seconds for r in found if r.variant == flow and r.across in rival}


def at_equal_error(found, flow):
    """{across: (cost of the grid for the flow's error over that of the flow, whether it is only a lower bound)}.

    Between measured points of the grid, never beyond: a bound where its finest run is still less exact; nothing where
    its coarsest run is better already.
    """
    grid = points(found, RIVAL)
    result = {}
    for point in points(found, flow):
        level = reach(grid, point.error)
        coarsest = min(grid, key=lambda p: p.resolution)
        if level is None:
            result[point.resolution] = (max(p.wall for p in grid) / point.wall, True)
        elif point.error <= coarsest.error:
            result[point.resolution] = (level.wall / point.wall, False)
    return result


def wrapped(lines):
    """Prose in lines of at most 120 characters; rows of tables as they are."""
    return [part for line in lines for part in ([line] if line.startswith("|") else textwrap.wrap(line, 120) or [""])]


def page(found, threads, machine, version):
    """The tables, Markdown."""
    cost = "processor time of stepping" if threads == 1 else f"wall time of stepping, Mesogen with {threads} threads"
    lines = ["# Particles against a grid", "",
             f"The deterministic benchmark to {END:g} s: {cost}; {machine}; {version}. `finite volume`: a serial "
             "solver on a staggered grid (`bench/reference/finite_volume`). `bench/rival.py` measures this table.", ""]
    header = ["method", "across", "error", "time (s)", "steps", "pressure", "diffusion"]
    rows = [[r.variant, r.across, "" if math.isnan(r.error) else percent(r.error),
             f"{r.seconds:.3g}" + ("" if r.source == "run" else " (predicted)"), r.steps,
             *("" if math.isnan(share) else f"{100 * share:.0f} %" for share in (r.pressure, r.diffusion))]
            for variant in [*FLOWS, *GRIDS] for r in found if r.variant == variant]
    lines += [*table_lines(header, rows, left=("method",)), ""]
    orders = [f"{variant} {order(line):.1f}" for variant in [*FLOWS, *GRIDS] if len(line := points(found, variant)) > 1]
    lines += [f"Order of convergence: {', '.join(orders)}.", "",
              f"Time of `{RIVAL}` divided by that of particles, at the same resolution and for the same error (`>`: the "
              f"finest run of `{RIVAL}` is still less exact):", ""]
    header = ["across"] + [f"{flow}, same {what}" for flow in FLOWS for what in ("resolution", "error")]
    same = {flow: at_equal_resolution(found, flow) for flow in FLOWS}
    error = {flow: at_equal_error(found, flow) for flow in FLOWS}
    rows = []
    for across in sorted({r.across for r in found}):
        row = [across]
        for flow in FLOWS:
            row.append(f"{same[flow][across]:.3g}" if across in same[flow] else "")
            ratio, bound = error[flow].get(across, (math.nan, False))
            row.append("" if math.isnan(ratio) else f"{'> ' if bound else ''}{ratio:.3g}")
        rows.append(row)
    return "\n".join(wrapped(lines + table_lines(header, rows))) + "\n"


def draw(found, threads, name):
    """Error against cost, and speed-up against resolution."""
    with look.settings():
        sheet, (left, right) = style.tiles(1, 2, (3.3, 3.0), margins=(0.75, 0.2, 0.4, 1.15))
        for number, variant in enumerate([*FLOWS, *GRIDS]):
            line = points(found, variant)
            left.plot([p.wall for p in line], [100 * p.error for p in line], label=variant, **look.look_of(number))
        run = [r for r in found if r.source == "run"]
        look.log_axis(left.xaxis, [r.seconds for r in run])
        look.log_axis(left.yaxis, [100 * r.error for r in run])
        left.set_xlabel(("processor time" if threads == 1 else f"time, particles with {threads} threads") + " (s)")
        left.set_ylabel("error (%)")
        left.set_title("Error against cost")
        ratios = [1.0]
        for number, flow in enumerate(FLOWS):
            colour = look.COLOURS[number]
            same = at_equal_resolution(found, flow)
            equal = at_equal_error(found, flow)
            right.plot(list(same), list(same.values()), "-o", ms=4.5, color=colour, label=f"{flow}, same resolution")
            for bound, marker in ((False, "s"), (True, "^")):
                those = {across: ratio for across, (ratio, low) in equal.items() if low == bound}
                if those:
                    right.plot(list(those), list(those.values()), marker, ls="--", ms=4.5, color=colour,
                               label=f"{flow}, same error" + (", at least" if bound else ""))
            ratios += [*same.values(), *(ratio for ratio, _ in equal.values())]
        right.axhline(1.0, color=style.QUIET, lw=0.8)
        across = sorted({r.across for r in found})
        look.log_axis(right.xaxis, across, ticks=across[:: 1 + len(across) // 6])
        look.log_axis(right.yaxis, ratios)
        right.set_xlabel("particles or cells across")
        right.set_ylabel("time of the grid / of particles")
        right.set_title("Speed-up over finite volumes, multigrid")
        for axes in (left, right):
            axes.spines[["top", "right"]].set_visible(False)
            axes.legend(loc="upper left", bbox_to_anchor=(-0.1, -0.16), ncols=2, columnspacing=1.0, fontsize=7.0)
        sheet.savefig(name, metadata={"Software": None})


def write_csv(found, name):
    columns = list(Result.__dataclass_fields__)
    with open(name, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        for result in found:
            values = (getattr(result, column) for column in columns)
            writer.writerow([v if not isinstance(v, float) else "" if math.isnan(v) else f"{v:.6g}" for v in values])


def numbers(text):
    return sorted(int(one) for one in text.split(",") if one)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=PROJECT / "build" / "release")
    parser.add_argument("--finite-volume", type=pathlib.Path, help="program (default: the build's, for this processor)")
    parser.add_argument("--across", type=numbers, default=[16, 24, 32, 48, 64, 96], help="where all is run")
    parser.add_argument("--large", type=numbers, default=[128, 192, 256, 512],
                        help="at which explicit steps are predicted")
    parser.add_argument("--threads", type=int, default=1, help="of Mesogen; the grid has one")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--charts", type=pathlib.Path, default=PROJECT / "docs" / "performance" / "rival")
    parser.add_argument("-o", "--output", help="file for the tables (default: print)")
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    if options.quick:
        options.across, options.large, options.repeats = [16, 24, 32], [48], 1
    options.build = options.build.resolve()
    program = options.finite_volume or options.build / "bin" / f"finite_volume-{instruction_set(options.build / 'bin' / 'mesogen')}"
    found = measure(options, program.resolve())
    options.charts.parent.mkdir(parents=True, exist_ok=True)
    write_csv(found, options.charts.with_suffix(".csv"))
    draw(found, options.threads, options.charts.with_suffix(".png"))
    text = page(found, options.threads, machine_text(), version_text(options.build / "bin" / "mesogen"))
    if options.output:
        pathlib.Path(options.output).write_text(text, encoding="utf-8")
    else:
        print(text, end="")


if __name__ == "__main__":
    main()
