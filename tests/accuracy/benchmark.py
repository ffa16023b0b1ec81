#!/usr/bin/python3
"""The deterministic benchmark at 36, 48 and 72 particles across: errors of v_rms at t = 40 s and their order.

    tests/accuracy/benchmark.py path/to/mesogen

Prints a line a resolution; exits with 1 if an error is above its bound or the order below 1.8. Takes some minutes."""

import math
import pathlib
import subprocess
import sys
import tempfile

import h5py

CASE = pathlib.Path(__file__).resolve().parents[2] / "cases/accuracy/benchmark/case.toml"
TIME = 40.0  # s
REFERENCE = 0.075667  # m/s, pseudo-spectral
BOUNDS = {36: 0.030, 48: 0.018, 72: 0.008}
LEAST_ORDER = 1.8


def error_at(command, across, folder):
    """Relative error of v_rms at TIME."""
    arguments = [command, "run", CASE, "--quiet", "--output", folder]
    for override in (f"particles.spacing={10.0 / across!r}", f"time.end={TIME}", f"output.interval={TIME}"):
        arguments += ["--set", override]
    subprocess.run(arguments, check=True)
    with h5py.File(folder / "results.h5") as results:
        series = results["observables/flow/v_rms"]
        assert abs(series["time"][-1] - TIME) < 1e-9
        return series["value"][-1] / REFERENCE - 1.0


def main(command):
    good = True
    errors = {}
    with tempfile.TemporaryDirectory() as folder:
        for across, bound in BOUNDS.items():
            errors[across] = error_at(command, across, pathlib.Path(folder) / str(across))
            good = good and abs(errors[across]) <= bound
            print(f"{across}^2: {100 * errors[across]:+.2f} % (at most {100 * bound:.1f} %)", flush=True)
    coarse, fine = min(BOUNDS), max(BOUNDS)
    order = math.log(abs(errors[coarse] / errors[fine])) / math.log(fine / coarse)
    print(f"order {order:.2f} (at least {LEAST_ORDER})")
    return 0 if good and order >= LEAST_ORDER else 1


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
