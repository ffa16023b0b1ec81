#!/usr/bin/python3
"""The reference solver against exact answers, and the answers in cases/accuracy against the scripts that made them."""

import math
import pathlib
import tomllib
import unittest

import numpy as np

import benchmark
import defect_pair
import flow_alignment
from spectral import Model, Solver

SCENES = pathlib.Path(__file__).resolve().parents[2] / "cases/accuracy"


def answers(scene, series):
    """{time: exact} of a quantity of a scene."""
    with open(SCENES / scene / "answer.toml", "rb") as file:
        for quantity in tomllib.load(file)["quantity"]:
            if quantity["series"] == series:
                return dict(zip(quantity["at"], quantity["exact"]))
    raise KeyError(f"{scene}: {series}")


def wave(mx, my, amplitude, length=1.0):
    """A small wave of the director, order 1, as a Solver's start."""
    def tensor(x, y):
        angle = amplitude * np.cos(2.0 * np.pi * (mx * x + my * y) / length)
        return np.cos(2.0 * angle), np.sin(2.0 * angle)
    return tensor


class Solutions(unittest.TestCase):
    def test_director_wave_decays(self):
        scene = Solver(Model(rotation=1.0, elastic=0.01, flow="none"), 1.0, 16, wave(1, 1, 1e-5))
        scene.advance(1.0, 0.05)
        self.assertAlmostEqual(np.max(scene.tensor()[1]) / 2e-5, math.exp(-0.01 * 8.0 * np.pi**2), places=7)

    def test_taylor_green_decays(self):
        model = Model(rotation=1.0, elastic=0.0, viscosity=0.01)
        scene = Solver(model, 1.0, 16, lambda x, y: (1.0 + 0.0 * x * y, 0.0 * x * y))
        x = 2.0 * np.pi * np.arange(16) / 16
        scene.state[2] = np.fft.rfft2(4.0 * np.pi * np.cos(x)[None, :] * np.cos(x)[:, None])
        self.assertAlmostEqual(scene.v_rms(), math.sqrt(0.5), places=12)
        scene.advance(0.4, 0.02)
        self.assertAlmostEqual(scene.v_rms(), answers("taylor_green", "flow.v_rms")[0.4], places=7)

    def test_bend_and_splay_grow(self):
        for name, mode, activity in (("bend_growth", (1, 0), 0.05), ("splay_growth", (0, 1), -0.05)):
            model = Model(rotation=0.4, elastic=0.02, alignment=0.7, activity=activity, viscosity=2.0 / 3.0)
            scene = Solver(model, 10.0, 16, wave(*mode, 1e-7, 10.0))
            scene.advance(40.0, 0.2)  # the other mode, of the flow, is gone
            before = scene.v_rms()
            scene.advance(50.0, 0.2)
            exact = answers(name, "flow.v_rms")[8.0]
            self.assertAlmostEqual(math.log(scene.v_rms() / before) / 10.0, exact, places=6, msg=name)

    def test_unknown_flow_is_refused(self):
        with self.assertRaisesRegex(ValueError, '"creeping", not "inertia"'):
            Model(rotation=1.0, elastic=0.1, flow="creeping")

    def test_too_long_a_step_is_told(self):
        scene = defect_pair_at(32)
        with self.assertRaisesRegex(ArithmeticError, "choose a shorter step"), np.errstate(all="ignore"):
            scene.advance(2000.0, 20.0)


def defect_pair_at(points):
    return Solver(Model(rotation=1.0, elastic=0.1, flow="none"), defect_pair.LENGTH, points, defect_pair.director)


class Answers(unittest.TestCase):
    def test_benchmark(self):
        scene = benchmark.solver(32)
        for time, v_rms, vorticity, order in ((20.0, 0.0237170, 0.0151793, 0.9953751),
                                              (30.0, 0.0462153, 0.0294543, 0.9828415),
                                              (40.0, 0.0756664, 0.0486519, 0.9540641)):
            scene.advance(time, 0.2)
            self.assertAlmostEqual(scene.v_rms(), v_rms, delta=3e-7)
            self.assertAlmostEqual(scene.vorticity_rms(), vorticity, delta=1e-6)
            self.assertAlmostEqual(scene.mean_order(), order, delta=3e-6)
            self.assertEqual(answers("benchmark", "flow.v_rms")[time], v_rms)

    def test_benchmark_without_inertia(self):
        scene = benchmark.solver(32, "stokes")
        for time, v_rms in ((10.0, 0.022271), (20.0, 0.051984), (30.0, 0.086556)):
            scene.advance(time, 0.2)
            self.assertAlmostEqual(scene.v_rms(), v_rms, delta=2e-6)

    def test_defect_pair(self):
        exact = answers("defect_pair", "defects.pair_distance")
        rows = defect_pair.distances(64, 0.05, sorted(exact))
        self.assertEqual([time for time, _ in rows], sorted(exact))
        for time, distance in rows:
            self.assertAlmostEqual(distance, exact[time], delta=5e-5)
        self.assertEqual(defect_pair.distances(32, 0.05, [6.0]), [])

    def test_flow_alignment(self):
        angles = answers("flow_alignment", "nematic.mean_director_angle")
        orders = answers("flow_alignment", "nematic.mean_order")
        for time, angle, order in flow_alignment.answer(heights=40, step=8e-3):
            self.assertAlmostEqual(angle, angles[round(time, 9)], delta=2e-6)
            self.assertAlmostEqual(order, orders[round(time, 9)], delta=2e-6)


if __name__ == "__main__":
    unittest.main()
