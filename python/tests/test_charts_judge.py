"""Verdicts on made-up runs: what failed, when, and what failed first."""

import math
import unittest

import numpy as np
import synthetic

import mesogen
from mesogen.charts import judge
from mesogen.charts.judge import Bounds
from mesogen.charts.scene import Quantity
from mesogen.errors import StudyError

TIME = np.linspace(0.0, 10.0, 11)
LATER = TIME > 6.5  # from t = 7 s on


class Judge(synthetic.FolderTest):
    def run_with(self, **changes):
        """A sound run, with these series changed."""
        series = {
            "v_rms": np.full(11, 2.0), "kinetic_energy": np.full(11, 10.0), "total_momentum": np.zeros((11, 1, 2)),
            "density_min": np.full(11, 0.99), "density_max": np.full(11, 1.01), "volume_min": np.full(11, 0.98),
            "volume_max": np.full(11, 1.02), "min_spacing": np.full(11, 0.7), **changes,
        }
        results = synthetic.Results(self.folder)
        for name, values in series.items():
            results.observable("stream", name, "1", values, steps=np.arange(11), times=TIME)
        return mesogen.open(results.close())

    def verdict(self, bounds=Bounds(), quantities=(), stopped="", **changes):
        with self.run_with(**changes) as run:
            return judge.judge(run, bounds, quantities, stopped)

    def assert_fails(self, verdict, how, time, words):
        self.assertEqual((verdict.how, verdict.time), (how, time))
        self.assertIn(words, verdict.reason)
        self.assertFalse(verdict.holds)

    def test_a_sound_run_holds(self):
        verdict = self.verdict()
        self.assertTrue(verdict.holds)
        self.assertAlmostEqual(verdict.extremes["volume"], 0.02, 3)
        self.assertEqual(verdict.extremes["clumping"], 0.7)

    def test_clumping(self):
        self.assert_fails(self.verdict(min_spacing=np.where(LATER, 0.29, 0.5)), "clumping", 7.0,
                          "two particles are 0.29 spacings apart, less than 0.3")

    def test_volume_and_density_either_way(self):
        self.assert_fails(self.verdict(volume_max=np.where(LATER, 1.06, 1.0), volume_min=np.ones(11)), "volume", 7.0,
                          "a particle's volume has changed by 6 %, more than 5 %")
        self.assert_fails(self.verdict(volume_min=np.where(LATER, 0.94, 1.0), volume_max=np.ones(11)), "volume", 7.0, "6 %")
        self.assert_fails(self.verdict(density_min=np.where(LATER, 0.96, 1.0), density_max=np.ones(11)), "density", 7.0,
                          "a particle's density has changed by 4 %, more than 3 %")

    def test_change_is_from_the_start(self):
        self.assertTrue(self.verdict(density_min=np.full(11, 998.0), density_max=np.full(11, 998.0)).holds)
        self.assertTrue(self.verdict(volume_min=np.full(11, 0.9), volume_max=np.full(11, 0.9)).holds)

    def test_energy_only_where_asked(self):
        grown = {"kinetic_energy": np.where(LATER, 11.0, 10.0)}
        self.assertTrue(self.verdict(**grown).holds)
        self.assert_fails(self.verdict(Bounds(energy=0.05), **grown), "energy", 7.0, "grown by 10 %, more than 5 %")

    def test_momentum_over_mass_and_speed(self):
        # mass 2 E / v^2 = 5, speed 2: 1 % of 10 is 0.1
        momentum = np.zeros((11, 1, 2))
        momentum[LATER, 0, 1] = -0.12
        self.assert_fails(self.verdict(total_momentum=momentum), "momentum", 7.0, "drifted by 1.2 %, more than 1 %")
        self.assertTrue(self.verdict(Bounds(momentum=0.02), total_momentum=momentum).holds)
        self.assertTrue(self.verdict(total_momentum=np.full((11, 1, 2), 0.12)).holds)  # it had that from the start

    def test_order_only_where_asked(self):
        bent = {"mean_order": np.where(LATER, 0.8, 1.0)}
        self.assertTrue(self.verdict(**bent).holds)
        self.assert_fails(self.verdict(Bounds(order=0.1), **bent), "order", 7.0, "the mean order has changed by 0.2")
        with self.assertRaises(StudyError) as raised:
            self.verdict(Bounds(order=0.1))
        self.assert_text(raised, "no observer of type nematic_statistics")

    def test_error(self):
        known = Quantity("stream", "v_rms", "value", (4.0,), (1.0,), None)
        self.assert_fails(self.verdict(quantities=[known]), "error", 4.0, "it is wrong by 100 %, more than 20 %")
        self.assertTrue(self.verdict(Bounds(error=None), [known]).holds)

    def test_a_rate_of_what_has_vanished_is_wrong(self):
        known = Quantity("stream", "v_rms", "growth_rate", (0.0, 10.0), (1.0,), None)
        verdict = self.verdict(quantities=[known], v_rms=np.where(LATER, 0.0, 2.0), kinetic_energy=np.full(11, 10.0))
        self.assert_fails(verdict, "error", 10.0, "inf")

    def test_the_first_of_several(self):
        verdict = self.verdict(min_spacing=np.where(TIME > 2.5, 0.1, 0.7), volume_max=np.where(LATER, 1.2, 1.0))
        self.assert_fails(verdict, "clumping", 3.0, "0.1")
        self.assertAlmostEqual(verdict.extremes["volume"], 0.2, 1)

    def test_what_stops_a_run(self):
        told = "the run broke down: 'compression' is 0.31 at particle 3 (1, 2), outside -0.3 to 0.3, at t = 8.5 s (step 9, ...)"
        self.assert_fails(self.verdict(stopped=told), "compression", 8.5, told)
        self.assert_fails(self.verdict(stopped=told, min_spacing=np.where(LATER, 0.2, 0.7)), "clumping", 7.0, "0.2")
        for text, way in (("the run broke down: 'velocity' is not finite at", "NaN"), ("the run ran away: the", "ran away"),
                          ("particles have left a void there, at t = 3 s", "void"), ("particles have gathered there", "gathering"),
                          ("are 0.02 spacings apart, less than 0.1", "pair"), ("took longer than 3 s", "too slow"),
                          ("something else", "stopped")):
            self.assertEqual(judge.way_of(text), way)

    def test_what_happens_before_does_not_count(self):
        changes = {"min_spacing": np.where(TIME < 2.5, 0.1, 0.7)}
        self.assertFalse(self.verdict(**changes).holds)
        self.assertTrue(self.verdict(Bounds(after=3.0), **changes).holds)

    def test_a_scene_without_flow(self):
        nothing = {name: np.full(11, np.nan) for name in ("v_rms", "kinetic_energy", "density_min", "density_max")}
        verdict = self.verdict(**nothing, total_momentum=np.full((11, 1, 2), np.nan))
        self.assertTrue(verdict.holds)
        self.assertEqual(sorted(verdict.extremes), ["clumping", "volume"])

    def test_a_fluid_at_rest(self):
        self.assertTrue(self.verdict(v_rms=np.zeros(11), kinetic_energy=np.zeros(11)).holds)

    def test_no_flow_statistics(self):
        results = synthetic.Results(self.folder)
        results.observable("stream", "v_rms", "m/s", TIME, steps=np.arange(11), times=TIME)
        with mesogen.open(results.close()) as run, self.assertRaises(StudyError) as raised:
            judge.judge(run, Bounds())
        self.assert_text(raised, "no observer of type flow_statistics")

    def test_times_of_stops(self):
        self.assertEqual(judge.stop_time("... at t = 1.5e-05 s (step", TIME), 1.5e-05)
        self.assertEqual(judge.stop_time("took longer", TIME), 10.0)
        self.assertTrue(math.isnan(self.verdict().time))


if __name__ == "__main__":
    unittest.main()
