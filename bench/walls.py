#!/usr/bin/python3
"""Which flow between walls? The channel, by each way that there is, error against time.

    bench/walls.py build/release/bin/mesogen [--across 12 24 48]

A force drives a fluid between two walls a metre apart, from rest to the parabola (Reynolds number 1). The ways: walls
of `wcsph`, in explicit and in stabilised steps; and `incompressible` in a periodic box with a band of strong friction
in place of the walls (Brinkman's porous walls), as deep as a tenth of a spacing lets the fluid in. Prints a table of
the relative error (L2 over the particles) after ten viscous times, the steps and the wall time on one thread.
"""

import argparse
import os
import subprocess
import sys
import tempfile
import time

import h5py
import numpy as np

BAND = 0.25  # m, of friction on each side

COMMON = """
[particles]
spacing = {spacing}
[kernel]
type = "quintic"
[physics.push]
type = "body_force"
force = [{force}, 0.0]
[time]
end = 1.0
stepping = "{stepping}"
[output]
interval = 1.0
fields = ["velocity"]
[run]
precision = "double"
"""
WALLS = """
[domain]
size = [1.0, 1.0]
boundary = {{ type = "walls", axes = ["y"] }}
[physics.flow]
type = "wcsph"
density = 1.0
viscosity = 1.0
"""
POROUS = """
[domain]
size = [1.0, {height}]
boundary = "periodic_wrap"
[physics.flow]
type = "incompressible"
density = 1.0
viscosity = 1.0
[physics.substrate]
type = "friction"
coefficient = "{friction} * (y < {low} || y > {high})"
"""

WAYS = [
    ("walls of `wcsph`, explicit steps", WALLS, "explicit", 0.0),
    ("walls of `wcsph`, stabilised steps", WALLS, "stabilised", 0.0),
    ("`incompressible`, porous walls", POROUS, "auto", BAND),
]


def measure(mesogen, text, floor):
    """Relative error, steps, s."""
    with tempfile.TemporaryDirectory() as folder:
        case = os.path.join(folder, "case.toml")
        with open(case, "w", encoding="utf-8") as file:
            file.write(text)
        begun = time.perf_counter()
        done = subprocess.run([mesogen, "run", case, "--output", os.path.join(folder, "out"), "--threads", "1"],
                              text=True, capture_output=True, check=False)
        seconds = time.perf_counter() - begun
        if done.returncode != 0:
            sys.exit(done.stderr)
        with h5py.File(os.path.join(folder, "out", "results.h5"), "r") as results:
            fluid = results["particles/fluid"]
            y = np.asarray(fluid["position/value"][-1])[:, 1] - floor
            u = np.asarray(fluid["velocity/value"][-1])[:, 0]
            steps = int(fluid["velocity/step"][-1])
    inside = (y > 0.0) & (y < 1.0)
    exact = 4.0 * y[inside] * (1.0 - y[inside])
    return np.sqrt(np.mean((u[inside] - exact) ** 2) / np.mean(exact**2)), steps, seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesogen")
    parser.add_argument("--across", type=int, nargs="+", default=[12, 24, 48])
    arguments = parser.parse_args()
    print("| way | particles across | error | steps | s |\n|---|---|---|---|---|")
    for name, text, stepping, floor in WAYS:
        for across in arguments.across:
            spacing = 1.0 / across
            values = {"spacing": spacing, "stepping": stepping, "force": 8.0, "height": 1.0 + 2.0 * BAND, "low": BAND,
                      "high": 1.0 + BAND, "friction": 100.0 / spacing**2}
            error, steps, seconds = measure(arguments.mesogen, (text + COMMON).format(**values), floor)
            print(f"| {name} | {across} | {100.0 * error:.2g} % | {steps} | {seconds:.2g} |", flush=True)


if __name__ == "__main__":
    main()
