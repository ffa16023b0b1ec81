"""Both sides of boundaries that the stability studies found (docs/stability.md): one run holds, the other fails as told."""

import os
import sys
import unittest

from support import MESOGEN, PROJECT, CommandTest

sys.path.insert(0, os.path.join(PROJECT, "python"))

from mesogen.charts.__main__ import read_study  # noqa: E402
from mesogen.charts.stability import run_trial  # noqa: E402


class Boundaries(CommandTest):
    def verdict(self, study, variant, across, value, **changes):
        """(how it failed, its reason) of one run of a study; changes: of the case, dots written as __."""
        study, _ = read_study(os.path.join(PROJECT, "studies", "stability", study + ".toml"))
        study.common.update({key.replace("__", "."): changed for key, changed in changes.items()})
        cell = next(cell for cell in study.cells() if cell.variant.name == variant and cell.across == across)
        row = run_trial(study, cell, value, self.folder, MESOGEN, None)
        return row["how"], row["reason"]

    def assert_sides(self, study, variant, across, inside, outside, *ways):
        self.assertEqual(self.verdict(study, variant, across, inside), ("", ""))
        how, reason = self.verdict(study, variant, across, outside)
        self.assertIn(how, ways, reason)

    def test_a_sound_too_slow(self):
        self.assert_sides("sound_speed", "default", 0.1, 6.0, 3.0, "density")

    def test_a_sound_too_fast_for_its_step(self):
        self.assert_sides("sound_speed", "half_steps", 0.01, 12.0, 40.0, "density", "energy")
        self.assertEqual(self.verdict("sound_speed", "default", 0.01, 40.0), ("", ""))  # the remedy

    def test_a_step_past_the_limit_of_motion(self):
        self.assert_sides("incompressible_step", "default", 0.1, 2.2, 2.8, "ran away")

    def test_a_step_past_the_limit_of_viscosity(self):
        self.assert_sides("step_factor", "viscosity", None, 1.5, 2.4, "clumping", "compression", "density", "void", "gathering", "ran away")

    def test_a_step_past_the_limit_of_elasticity(self):
        self.assert_sides("step_factor", "elasticity", None, 1.5, 2.4, "order")

    def test_a_step_past_the_limit_of_relaxation(self):
        self.assert_sides("step_factor", "relaxation", None, 5.0, 8.75, "order")

    def test_a_kernel_with_too_few_neighbours(self):
        self.assert_sides("smoothing_length", "wendland_c6", None, 1.2, 1.0, "volume", "compression", "density")

    def test_disorder_that_nothing_spreads(self):
        self.assert_sides("jitter", "no_shift", 1, 0.2, 0.45, "clumping")
        self.assertEqual(self.verdict("jitter", "default", 1, 0.45), ("", ""))  # the remedy

    def test_a_filter_that_is_fed_back(self):
        self.assert_sides("filter_feedback", "feedback", 0.1, 12.0, 30.0, "volume")
        self.assertEqual(self.verdict("filter_feedback", "no_feedback", 0.1, 30.0), ("", ""))  # the remedy

    def test_an_activity_too_strong_for_the_density_filter(self):
        self.assert_sides("activity_extensile", "density_filter", 0.2, 0.12, 0.2, "density")
        self.assertEqual(self.verdict("activity_extensile", "expected_0_4", 0.2, 0.2), ("", ""))  # the remedy

    def test_a_viscosity_too_low_for_the_density_filter(self):
        self.assert_sides("reynolds_number", "density_filter", 0.05, 0.009, 0.004, "density", "energy")
        self.assertEqual(self.verdict("reynolds_number", "default", 0.05, 0.004), ("", ""))  # the remedy

    def test_reynolds_number(self):
        self.assert_sides("reynolds_number", "half_steps", 0.05, 0.04, 0.015, "density", "energy")
        self.assertEqual(self.verdict("reynolds_number", "default", 0.05, 0.015), ("", ""))  # the remedy


if __name__ == "__main__":
    unittest.main()
