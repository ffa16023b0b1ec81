#!/usr/bin/python3
"""Taylor-Green vortices at Re = 100 to t = 0.4 s by Mesogen and by PySPH: error against time on one core.

    bench/peers/taylor_green.py [--mesogen build/release/bin/mesogen] [--across 50 100] [--repeats 1] [-o docs/accuracy]

Runs one program after the other, each on one core, and writes peers.csv, .md, .png and .svg. Needs Debian's
python3-pysph beside what Mesogen needs. Error: of the rms velocity at t = 0.4 s against exp(-8 pi^2 nu t / L^2). Time:
processor time of the time steps alone; set-up is left out (PySPH's is measured by a run of one step)."""

import argparse
import csv
import math
import os
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile

PROJECT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(PROJECT / "python"))

import mesogen  # noqa: E402
from mesogen.charts.drawing import look  # noqa: E402

END = 0.4  # s
EXACT = math.sqrt(0.5) * math.exp(-8.0 * math.pi**2 * 0.01 * END)  # m/s
ONE_CORE = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MPLBACKEND": "Agg"}
JITTERED = ["particles.arrangement=jittered", "particles.jitter=0.1"]
VARIANTS = {  # name: (program, arguments); PySPH's perturb = 0.2 moves particles by as much as a jitter of 0.1
    "Mesogen": ("mesogen", []),
    "Mesogen, single precision": ("mesogen", ["run.precision=single"]),
    "Mesogen, jittered start": ("mesogen", JITTERED),
    "PySPH TVF": ("pysph", ["--scheme", "tvf"]),
    "PySPH TVF, jittered start": ("pysph", ["--scheme", "tvf", "--perturb", "0.2"]),
    "PySPH TVF, h = 1.3 dx, jittered start": ("pysph", ["--scheme", "tvf", "--perturb", "0.2", "--hdx", "1.3"]),
    "PySPH EDAC, jittered start": ("pysph", ["--scheme", "edac", "--perturb", "0.2"]),
}
COLUMNS = ["variant", "across", "particles", "steps", "core_seconds", "particle_steps_per_second", "v_rms_error",
           "volume_ratio"]  # largest over smallest volume of a particle at the end
TEXT = """# Mesogen beside PySPH

Taylor-Green vortices at Re = 100, doubly periodic, to t = 0.4 s (U = L = 1). All programs have the same number of
particles, c0 = 10 U, the quintic kernel and one core. Time is the processor time of the steps. The error is that of the
rms velocity against the exact decay. Spread is the largest over the smallest particle volume at the end. {note}

![error against time](peers.png)

{table}

- All start on a lattice unless "jittered", where each particle is moved by up to 0.1 dx along each axis. From a lattice
  the example of PySPH loses far more speed than it should; with its own option `--perturb` it is much better, so both
  are shown.
- The error is that of one number at one time. It passes through 0 during a run, so a small error can be luck. The error
  of EDAC does not fall from 50² to 100².
- The default of PySPH is h = 1 dx for TVF and EDAC. The default of Mesogen is h = 4/3 dx, which costs 1.8 times as many
  pairs.

`bench/peers/taylor_green.py` writes this page; `bench/peers/README.md` says what it needs.
"""


def processor_seconds(command, folder):
    """Runs a program to its end; returns the seconds of processor time that it took."""
    def spent():
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime
    before = spent()
    done = subprocess.run(command, cwd=folder, env=ONE_CORE, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(f"{' '.join(map(str, command))}:\n{done.stdout}{done.stderr}")
    return spent() - before


def run_mesogen(program, across, arguments, folder):
    """(steps, seconds, v_rms, volume ratio)."""
    case = PROJECT / "cases/accuracy/taylor_green/case.toml"
    command = [program, "run", case, "--quiet", "--threads", "1", "--output", folder / "out",
               "--set", f"particles.spacing={1.0 / across!r}", "--set", f"time.end={END}"]
    for override in arguments:
        command += ["--set", override]
    processor_seconds(command, folder)
    with mesogen.open(folder / "out") as run:
        v_rms, smallest, largest = (float(run.series("flow", name)[1][-1])
                                    for name in ("v_rms", "volume_min", "volume_max"))
        return run.cost.steps, run.cost.cpu_seconds, v_rms, largest / smallest


def run_pysph(across, arguments, folder):
    """(steps, seconds, v_rms, volume ratio); a volume is 1 / sum_j W_ij, which is m / rho here."""
    import numpy
    from pysph.solver.utils import get_files, load
    common = [sys.executable, "-m", "pysph.examples.taylor_green", "--nx", str(across), "--re", "100", "--pfreq",
              "1000000", *arguments]
    processor_seconds([*common, "--max-steps", "1", "-d", "compiled"], folder)  # it compiles at its first run
    set_up = processor_seconds([*common, "--max-steps", "1", "-d", "set_up"], folder)
    full = processor_seconds([*common, "--tf", str(END), "-d", "out"], folder)
    last = load(get_files(str(folder / "out"), "taylor_green")[-1])
    fluid, solver = last["arrays"]["fluid"], last["solver_data"]
    if abs(solver["t"] - END) > 1e-9 or len(fluid.u) != across**2:
        raise SystemExit(f"PySPH's last file holds {len(fluid.u)} particles at t = {solver['t']}")
    v_rms = float(numpy.sqrt(numpy.mean(fluid.u**2 + fluid.v**2)))
    return int(solver["count"]), full - set_up, v_rms, float(fluid.rho.max() / fluid.rho.min())


def measure(options):
    """Rows of COLUMNS: a row a variant and resolution, the median of the repeats' times."""
    rows = []
    for across in options.across:
        times = {name: [] for name in VARIANTS}
        last = {}
        for _ in range(options.repeats):
            for name, (program, arguments) in VARIANTS.items():
                with tempfile.TemporaryDirectory() as folder:
                    folder = pathlib.Path(folder)
                    steps, seconds, v_rms, ratio = (run_pysph(across, arguments, folder) if program == "pysph" else
                                                    run_mesogen(options.mesogen, across, arguments, folder))
                times[name].append(seconds)
                last[name] = steps, v_rms, ratio
                print(f"{name}, {across} x {across}: {100 * (v_rms / EXACT - 1):+.2f} %, {seconds:.2f} s", flush=True)
        for name, (steps, v_rms, ratio) in last.items():
            seconds = statistics.median(times[name])
            rows.append([name, across, across**2, steps, f"{seconds:.3f}", f"{steps * across**2 / seconds:.0f}",
                         f"{v_rms / EXACT - 1:.6f}", f"{ratio:.3f}"])
    return rows


def text(rows, note):
    lines = [["variant", "particles", "error", "steps", "time, s", "particle steps / s", "spread"], ["---"] * 7]
    for name, across, _, steps, seconds, rate, error, ratio in rows:
        lines.append([name, f"{across}²", f"{100 * float(error):+.2f} %", str(steps), f"{float(seconds):.3g}",
                      f"{float(rate) / 1e6:.2f} million", f"{float(ratio):.2f}"])
    return TEXT.format(note=note, table="\n".join("| " + " | ".join(line) + " |" for line in lines))


def draw(rows, stem):
    """The chart: a line a variant."""
    with look.settings():
        page, axes = look.chart("Taylor-Green vortices, Re = 100, t = 0.4 s",
                                "error of the rms velocity against time on one core", width=8.6, legend=3.1)
        seconds, errors = [float(row[4]) for row in rows], [100 * abs(float(row[6])) for row in rows]
        look.log_axis(axes.xaxis, seconds)
        look.log_axis(axes.yaxis, errors)
        for number, name in enumerate(VARIANTS):
            chosen = [n for n, row in enumerate(rows) if row[0] == name]
            axes.plot([seconds[n] for n in chosen], [errors[n] for n in chosen], label=name, **look.look_of(number))
            for n in chosen:
                axes.annotate(f"{rows[n][1]}²", (seconds[n], errors[n]), xytext=(4, 4), textcoords="offset points",
                              fontsize=7.0)
        axes.set_xlabel("processor time (s)")
        axes.set_ylabel("error (%)")
        look.legend(axes)
        return look.save(page, stem)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mesogen", default=PROJECT / "build/release/bin/mesogen", type=pathlib.Path)
    parser.add_argument("--across", nargs="+", type=int, default=[50, 100])
    parser.add_argument("--repeats", type=int, default=1)
    parser.add_argument("-o", "--output", default=PROJECT / "docs/accuracy", type=pathlib.Path)
    parser.add_argument("--note", default="", help="a sentence about the machine, for the page")
    parser.add_argument("--csv", type=pathlib.Path, help="draw what was measured before")
    options = parser.parse_args()
    options.mesogen = options.mesogen.resolve()
    if options.csv:
        with open(options.csv, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))[1:]
    else:
        rows = measure(options)
    options.output.mkdir(parents=True, exist_ok=True)
    with open(options.output / "peers.csv", "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([COLUMNS, *rows])
    (options.output / "peers.md").write_text(text(rows, options.note), encoding="utf-8")
    draw(rows, str(options.output / "peers"))
    print(f"{options.output}/peers.csv, .md, .png, .svg")


if __name__ == "__main__":
    main()
