#!/usr/bin/python3
"""Statistics of active turbulence by both flows, over seeds, beside a pseudo-spectral reference.

    bench/turbulence.py build/release/bin/mesogen [--across 96] [--seeds 3] [--flows incompressible,wcsph]
                        [--threads 1] [--parallel 1] [-o docs/statistics.md]

Runs cases/active_turbulence/extensile.toml and contractile.toml to 600 s and averages over 300 to 600 s, each seed by
itself. Errors are standard errors over the seeds; with one seed, over six blocks of time. Drift: the mean over 450 to
600 s relative to the mean over 150 to 300 s. All defects of the order tensor count, close pairs too. With 96 x 96
particles a run takes a minute with `incompressible`, seven with `wcsph`.
"""

import argparse
import os
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

import numpy as np

PROJECT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
CASES = {"extensile, 0.03 Pa": "extensile", "contractile, -0.03 Pa": "contractile"}
# 64^2 to 256^2 points, three seeds; of the extensile case.
REFERENCE = "| extensile, 0.03 Pa | pseudo-spectral reference | 0.1584 ± 0.0005 | 0.785 ± 0.003 | 24.1 ± 0.6 | 0.121 ± 0.003 | | |"
NOTE = """\
Use these numbers to compare your own runs of `cases/active_turbulence/extensile.toml` and `contractile.toml`, or those
of another solver, with Mesogen's. `bench/turbulence.py` measures them and writes this page.

- Values are means over 300 to 600 s. Errors are standard errors over the seeds; with one seed, over six blocks of time.
- `defects` counts all defects that the order tensor has, including close pairs of opposite charges.
- `drift of the vorticity` is the mean over 450 to 600 s relative to the mean over 150 to 300 s.
- `s a run` is the wall time of the steps of one run.
- The box is small, so v rms goes slowly up and down during a run."""
WINDOW, EARLY, LATE = (300.0, 600.0), (150.0, 300.0), (450.0, 600.0)
QUANTITIES = {"vorticity_rms": ("flow", "vorticity_rms"), "order": ("nematic", "mean_order"),
              "defects": ("pairs", "count_plus"), "v_rms": ("flow", "v_rms")}


def run_one(mesogen, case, flow, across, seed, threads, folder):
    """{quantity: (time, value)} of a run, and its wall time of stepping, s."""
    sys.path.insert(0, os.path.join(PROJECT, "python"))
    import mesogen as results
    output = os.path.join(folder, f"{case}_{flow}_{seed}")
    settings = [f"physics.flow.type={flow}", f"particles.spacing={10.0 / across!r}", f"director.seed={seed}",
                "observers.pairs.type=defects", "observers.pairs.interval=2.0", "observers.pairs.merge_distance=0.0",
                "output.interval=600.0"]
    subprocess.run([mesogen, "run", os.path.join(PROJECT, "cases", "active_turbulence", case + ".toml"), "--quiet",
                    "--output", output, "--threads", str(threads), *[x for s in settings for x in ("--set", s)]], check=True)
    run = results.open(output)
    found = {name: tuple(np.asarray(x) for x in run.series(*where)) for name, where in QUANTITIES.items()}
    time, minus = run.series("pairs", "count_minus")
    found["defects"] = (time, found["defects"][1] + minus)
    cost = run.cost.wall_seconds
    run.close()
    return found, cost


def mean(series, window):
    time, value = series
    return float(value[(time > window[0]) & (time <= window[1])].mean())


def blocks(series, window, count=6):
    time, value = series
    inside = value[(time > window[0]) & (time <= window[1])]
    return [float(part.mean()) for part in np.array_split(inside, count)]


def row(title, flow, across, runs):
    """A line of the table, of the runs of all seeds."""
    cells = []
    for name, digits in (("vorticity_rms", 4), ("order", 3), ("defects", 1), ("v_rms", 3)):
        means = [mean(found[name], WINDOW) for found, _ in runs]
        spread = means if len(means) > 1 else blocks(runs[0][0][name], WINDOW)
        error = np.std(spread, ddof=1) / np.sqrt(len(spread))
        cells.append(f"{np.mean(means):.{digits}f} ± {error:.{digits}f}")
    early, late = (np.mean([mean(found["vorticity_rms"], when) for found, _ in runs]) for when in (EARLY, LATE))
    cost = np.median([wall for _, wall in runs])
    return (f"| {title} | {flow}, {across} x {across}, {len(runs)} seed{'s' if len(runs) > 1 else ''} | "
            + " | ".join(cells) + f" | {100.0 * (late / early - 1.0):+.1f} % | {cost:.0f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesogen")
    parser.add_argument("--across", type=int, default=96)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--flows", default="incompressible,wcsph")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--parallel", type=int, default=1, help="runs at a time")
    parser.add_argument("-o", "--output", help="file for the table")
    options = parser.parse_args()
    lines = ["# Statistics of active turbulence", "", NOTE, "", "| scene | flow | vorticity rms, 1/s | order | defects | v rms, m/s | drift of the vorticity | s a run |",
             "|---|---|---|---|---|---|---|---|", REFERENCE]
    with tempfile.TemporaryDirectory(prefix="mesogen-") as folder, ThreadPoolExecutor(options.parallel) as pool:
        waiting = [(title, flow, [pool.submit(run_one, options.mesogen, case, flow, options.across, seed + 1,
                                              options.threads, folder) for seed in range(options.seeds)])
                   for title, case in CASES.items() for flow in options.flows.split(",")]
        for title, flow, runs in waiting:
            lines.append(row(title, flow, options.across, [one.result() for one in runs]))
            print(lines[-1], flush=True)
    if options.output:
        with open(options.output, "w", encoding="utf-8") as file:
            file.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
