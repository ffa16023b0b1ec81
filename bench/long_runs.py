#!/usr/bin/python3
"""What does a long run keep? The deterministic benchmark goes on into chaos for 100,000 steps, in several forms: with
stabilised steps, the default, and with explicit ones.

    bench/long_runs.py build/release/bin/mesogen [--across 24] [--steps 100000] [-o docs/accuracy/long_runs.md]

Volumes of particles tell how evenly the shift keeps them spread; momentum, which nature conserves, what each form of the
forces adds; density how weakly the fluid is compressed. All are sampled 400 times. About one minute a form with
24 x 24 particles, one thread each.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import textwrap

import numpy as np

PROJECT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
CASE = os.path.join(PROJECT, "cases", "accuracy", "benchmark", "case.toml")
EDGE, DENSITY = 10.0, 1.0  # m, kg/m3: of the case
PUBLISHED = ["physics.flow.type=wcsph_published"]
# In all else as wcsph.
FILTER_ALONE = [*PUBLISHED, "physics.flow.viscosity_form=component", "physics.flow.shift_speed=strain",
                "physics.flow.shift=0.3", "physics.flow.density_diffusion=0.1"]
EXPLICIT = "time.stepping=explicit"
FORMS = [
    ("the default", []),
    ("explicit steps", [EXPLICIT]),
    ("shift = 1", [EXPLICIT, "physics.flow.shift=1"]),
    ("density filter", [EXPLICIT, *FILTER_ALONE]),
    ("conservative active stress and pressure",
     [EXPLICIT, "physics.activity.form=conservative", "physics.flow.pressure_form=conservative"]),
    ("the published scheme", [*PUBLISHED, "kernel.laplacian=plain", "time.scheme=half_steps"]),
]


def spread_of_volumes(run):
    """Root mean square of V / V0 - 1 over all particles and the frames of the second half."""
    late = range(len(run.times) // 2, len(run.times))
    return float(np.sqrt(np.mean([(run.field("volume", n) / run.field("volume", n).mean() - 1) ** 2 for n in late])))


def row(name, run):
    """A line of the table. run: mesogen.Run."""
    def series(quantity):
        return run.series("flow", quantity)[1]
    low, high, speed = series("volume_min"), series("volume_max"), series("v_rms")
    late = slice(len(low) // 4, None)  # when it is chaotic
    mass = DENSITY * EDGE**2
    drift = np.abs(series("total_momentum").reshape(len(speed), 2)).max() / (mass * speed.max())
    return (f"| {name} | {run.cost.steps:,} | {100 * spread_of_volumes(run):.2f} | "
            f"{100 * (low[late].mean() - 1):+.1f} to {100 * (high[late].mean() - 1):+.1f} | "
            f"{100 * (low.min() - 1):+.1f} to {100 * (high.max() - 1):+.1f} | {series('min_spacing').min():.2f} | "
            f"{100 * (series('density_min').min() / DENSITY - 1):+.1f} to "
            f"{100 * (series('density_max').max() / DENSITY - 1):+.1f} | {drift:.1e} | {speed[late].mean():.4f} |")


def run_form(mesogen, changes, across, end, folder, threads):
    """mesogen.Run of a form, or what the program said if it stopped."""
    sys.path.insert(0, os.path.join(PROJECT, "python"))
    import mesogen as results
    sampling = end / 400
    settings = [f"particles.spacing={EDGE / across!r}", f"time.end={end!r}", f"observers.flow.interval={sampling!r}",
                f"observers.nematic.interval={sampling!r}", f"output.interval={end / 40!r}",
                'output.fields=["position", "volume"]', *changes]
    words = [word for setting in settings for word in ("--set", setting)]
    done = subprocess.run([mesogen, "run", CASE, *words, "--threads", str(threads), "--quiet", "--output", folder],
                          check=False, capture_output=True, text=True)
    if done.returncode != 0:
        return (done.stderr.strip().splitlines() or [f"exit code {done.returncode}"])[-1]
    return results.open(folder)


def step_size(mesogen, across, *changes):
    """Size of the step with these changes of the case, s."""
    words = [word for setting in (f"particles.spacing={EDGE / across!r}", *changes) for word in ("--set", setting)]
    done = subprocess.run([mesogen, "check", CASE, *words, "--quick", "--json"], check=True, capture_output=True,
                          text=True)
    return json.loads(done.stdout)["steps"]["step"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesogen")
    parser.add_argument("--across", type=int, default=24, help="particles along each edge of the box")
    parser.add_argument("--steps", type=int, default=100_000,
                        help="of the default; and of explicit steps, to whose end all other forms go")
    parser.add_argument("--threads", type=int, default=1, help="of each run")
    parser.add_argument("-o", "--output", help="file to write (default: print)")
    options = parser.parse_args()
    mesogen = os.path.abspath(options.mesogen)
    longest = options.steps * step_size(mesogen, options.across)
    end = options.steps * step_size(mesogen, options.across, EXPLICIT)
    lines = ["# What a long run keeps", "",
             *textwrap.wrap(
                 f"This page shows what {options.steps:,} steps keep: how evenly particles lie, the density, and the "
                 f"momentum. The deterministic benchmark with {options.across} x {options.across} particles continues to "
                 f"t = {end:.0f} s, and with the default, stabilised steps, to t = {longest:.0f} s; from about 50 s on "
                 "it is chaotic. The rms of the volumes is over all particles in the second half of the time. Means are "
                 "over the last three quarters. `bench/long_runs.py` writes this page.", 120), "",
             "| form | steps | volumes: rms, % | mean extremes, % | extremes ever, % | nearest two ever, dx | density ever, % | "
             "momentum / (mass x largest v_rms) | v_rms, m/s |", "|---|---|---|---|---|---|---|---|---|"]
    for name, changes in FORMS:
        print(f"\r{name:60}", end="", file=sys.stderr, flush=True)
        with tempfile.TemporaryDirectory(prefix="mesogen-") as folder:
            run = run_form(mesogen, changes, options.across, end if changes else longest, os.path.join(folder, "run"),
                           options.threads)
            if isinstance(run, str):
                lines.append(f"| {name} | stopped: {run} | | | | | | | |")
            else:
                with run:
                    lines.append(row(name, run))
    print(file=sys.stderr)
    lines += ["", *textwrap.wrap(
        "By itself momentum drifts: sums over neighbours leave a small net force, and a uniform flow grows by chance, as "
        "in the published scheme. It does not change the rest of the flow, but it adds to paths and to v_rms. In a box "
        "that is periodic along every axis, where no force comes from outside, `wcsph` takes it away every 8 steps.",
        120)]
    text = "\n".join(lines) + "\n"
    if options.output:
        with open(options.output, "w", encoding="utf-8") as file:
            file.write(text)
    else:
        print(text, end="")


if __name__ == "__main__":
    main()
