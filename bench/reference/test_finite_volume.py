#!/usr/bin/python3
"""The finite-volume rival against exact answers.

    bench/reference/test_finite_volume.py build/release/bin/finite_volume
"""

import csv
import math
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else ""

V_RMS = {20.0: 0.0237170, 30.0: 0.0462153, 40.0: 0.0756664}  # m/s, of spectral.py: README.md
VORTICITY, ORDER = 0.0486519, 0.9540641  # 1/s and 1, at 40 s


def call(**options):
    """The finished process; an option named True is given without a value."""
    words = [word for name, value in options.items() for word in (f"--{name}", value) if word is not True]
    return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=False)


def rows(**options):
    """What it prints, a dictionary of numbers a row."""
    done = call(csv=True, **options)
    if done.returncode:
        raise AssertionError(done.stderr)
    return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(done.stdout.splitlines())]


def last(**options):
    return rows(**options)[-1]


def eigenvalue(waves, length, cells):
    """-lap of a wave on the grid, 1/m^2: what the fields must decay with, to the solver's last digit."""
    h = length / cells
    return sum((2.0 - 2.0 * math.cos(2.0 * math.pi * m * h / length)) / h**2 for m in waves)


class Benchmark(unittest.TestCase):
    def test_errors_fall_with_the_square_of_the_cell(self):
        errors = []
        for cells in (24, 48, 96):
            found = last(cells=cells, end=40, factor=0.25, pressure="fft")
            errors.append(1.0 - found["v_rms"] / V_RMS[40.0])
        self.assertLess(errors[1], 6e-3)
        for coarse, fine in zip(errors, errors[1:]):
            self.assertAlmostEqual(math.log2(coarse / fine), 2.0, delta=0.1)

    def test_extrapolated_to_no_cell_it_is_the_reference(self):
        runs = [rows(cells=cells, end=40, factor=0.25, pressure="fft") for cells in (48, 96)]
        for coarse, fine in zip(*(run[2:] for run in runs)):
            value = {name: (4.0 * fine[name] - coarse[name]) / 3.0 for name in ("v_rms", "vorticity_rms", "mean_order")}
            self.assertAlmostEqual(value["v_rms"] / V_RMS[fine["time"]], 1.0, delta=2e-4)
        self.assertAlmostEqual(value["vorticity_rms"] / VORTICITY, 1.0, delta=2e-4)
        self.assertAlmostEqual(value["mean_order"], ORDER, delta=2e-5)

    def test_errors_fall_with_the_step(self):
        for scheme, order in (("backward", 2.0), ("euler", 1.0)):
            found = [last(cells=24, end=40, step=step, pressure="fft", time_scheme=scheme)["v_rms"]
                     for step in (0.2, 0.1, 0.05)]
            ratio = (found[1] - found[0]) / (found[2] - found[1])
            self.assertAlmostEqual(math.log2(ratio), order, delta=0.15, msg=scheme)

    def test_steps_that_differ_keep_the_order(self):
        """Rows at odd times make the steps unequal."""
        even = last(cells=24, end=40, step=0.05)["v_rms"]
        for step in (0.2, 0.1):
            odd = last(cells=24, end=40, step=step, interval=0.7)["v_rms"]
            self.assertAlmostEqual(odd / even, 1.0, delta=0.04 * step**2)

    def test_multigrid_and_transforms_agree(self):
        for cells in (24, 20, 30, 64):  # coarsest grids of 3, 5, 15 and 2 cells
            exact = last(cells=cells, end=30, pressure="fft")
            found = last(cells=cells, end=30, tolerance=1e-10)
            self.assertAlmostEqual(found["v_rms"], exact["v_rms"], delta=1e-10)
            self.assertAlmostEqual(last(cells=cells, end=30)["v_rms"] / exact["v_rms"], 1.0, delta=2e-5)
            self.assertLess(exact["divergence_rms"], 1e-14)
            self.assertLess(found["divergence_rms"], 1e-10)

    def test_a_file_of_parameters(self):
        with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
            file.write("# contractile\nactivity = -0.05\n\ndirector = 0,1,0.1,0; 1,0,0.02,0.5  # two waves\n")
            file.flush()
            told = last(parameters=file.name, cells=16, end=5)
        same = last(activity=-0.05, director="0,1,0.1,0; 1,0,0.02,0.5", cells=16, end=5)
        self.assertEqual(told["v_rms"], same["v_rms"])
        self.assertNotEqual(told["v_rms"], last(cells=16, end=5)["v_rms"])

    def test_what_it_prints(self):
        lines = call(cells=16, end=20).stdout.splitlines()
        self.assertEqual(lines[0].split(), ["t/s", "v_rms/(m/s)", "vorticity_rms", "s", "mean_order", "angle_rms/rad"])
        self.assertEqual([line.split()[0] for line in lines[1:4]], ["0", "10", "20"])
        self.assertRegex(lines[4], r"^16 x 16 cells, 128 steps, \S+ s of processor time: pressure \d+ %, "
                                   r"diffusion \d+ %; \d\.\d V cycles for the pressure a step$")
        self.assertEqual(rows(cells=16, end=20)[-1]["steps"], 128)


class Exact(unittest.TestCase):
    def test_taylor_green_vortices_decay(self):
        begin, end = rows(case="taylor_green", cells=32, end=0.4, step=0.0025, pressure="fft")
        rate = 0.01 * eigenvalue((1, 1), 1.0, 32)
        self.assertAlmostEqual(begin["v_rms"], math.sqrt(0.5), places=9)
        self.assertAlmostEqual(end["v_rms"] / begin["v_rms"], math.exp(-0.4 * rate), delta=2e-6)
        self.assertAlmostEqual(last(case="taylor_green", cells=96, end=0.4)["v_rms"], 0.5156119, delta=1e-4)

    def test_a_wave_of_the_director_decays(self):
        wave = {"case": "relaxation", "director": "1,2,1e-4,0.3", "cells": 32, "end": 20, "step": 0.05}
        for solver in ("fft", "multigrid"):
            begin, *_, end = rows(pressure=solver, tolerance=1e-10, **wave)
            self.assertAlmostEqual(begin["angle_rms"], 1e-4 / math.sqrt(2.0), delta=1e-12)
            rate = 0.4 * 0.02 * eigenvalue((1, 2), 10.0, 32)
            self.assertAlmostEqual(end["angle_rms"] / begin["angle_rms"], math.exp(-20.0 * rate), delta=1e-6)

    def test_order_grows_to_one(self):
        """dq/dt = Gamma q (1 - q^2)."""
        found = last(case="relaxation", director="", order=0.5, cells=4, end=4, step=0.0025)
        self.assertAlmostEqual(found["mean_order"], 1.0 / math.sqrt(1.0 + 3.0 * math.exp(-2.0 * 0.4 * 4.0)), delta=1e-6)
        self.assertEqual(found["v_rms"], 0.0)


class Refusals(unittest.TestCase):
    def check(self, message, code=2, **options):
        done = call(**options)
        self.assertEqual((done.returncode, done.stderr.strip()), (code, message))

    def test_of_options(self):
        self.check('no option "cell"; --help lists them', cell=24)
        self.check('"--end" is not --OPTION VALUE; --help lists them', end=True)
        self.check('cells is "2", not a number from 4 to 8192', cells=2)
        self.check('cells is "12.5", not even', cells=12.5)
        self.check('cells is "33", not even', cells=33)
        self.check('end is "soon", not a number from 1e-09 to 1e+12', end="soon")
        self.check('pressure is "jacobi", not fft or multigrid', pressure="jacobi")
        self.check('time_scheme is "leapfrog", not backward or euler', time_scheme="leapfrog")
        self.check('flow is "stokes", not inertia or none', flow="stokes")
        self.check('case is "cavity", not benchmark, taylor_green or relaxation', case="cavity")
        self.check('a wave of director is "1,2", not mx,my,amplitude,phase', director="1,2")
        self.check("cells is 46: multigrid halves it down to 23, more than 15; or take --pressure fft", cells=46)

    def test_of_files(self):
        self.check("cannot read /nowhere/at/all", parameters="/nowhere/at/all")
        with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
            file.write("cells 48\n")
            file.flush()
            self.check(f'a line of {file.name} is "cells 48", not name = value', parameters=file.name)

    def test_a_lost_solution_is_told(self):
        done = call(cells=24, end=10000, interval=10000, step=20)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"^the solution is lost at t = \d+\.0+ s: choose a shorter step$")


if __name__ == "__main__":
    if not PROGRAM:
        sys.exit(__doc__)
    unittest.main()
