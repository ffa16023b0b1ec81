"""Means, errors and the verdicts that they allow."""

import math
import unittest

from mesogen.claims import DOES_NOT_HOLD, HOLDS, NOT_RESOLVED, Claim, Estimate, above, agrees, over_seeds
from mesogen.claims.estimate import slope
from mesogen.claims.verdict import all_of


class Estimates(unittest.TestCase):
    def test_error_is_that_of_the_mean(self):
        found = over_seeds([1.0, 2.0, 3.0])
        self.assertEqual((found.mean, found.count), (2.0, 3))
        self.assertAlmostEqual(found.error, 1.0 / math.sqrt(3.0))

    def test_one_value_has_no_error_and_none_has_no_mean(self):
        self.assertTrue(math.isnan(over_seeds([1.0]).error))
        self.assertTrue(math.isnan(over_seeds([math.nan]).mean))
        self.assertEqual(over_seeds([math.nan, 4.0, 4.0]), Estimate(4.0, 0.0, 2))

    def test_text_has_as_many_digits_as_asked_for(self):
        self.assertEqual(Estimate(0.15842, 0.00051, 3).text(), "0.1584 ± 0.0005")
        self.assertEqual(Estimate(24.13, 0.6, 3).text(), "24.1 ± 0.6")
        self.assertEqual(Estimate(1234.0, 9.0, 3).text(2), "1234 ± 9")
        self.assertEqual(Estimate(2.0, math.nan, 1).text(2), "2.0")
        self.assertEqual(Estimate(math.nan, math.nan, 0).text(), "none")

    def test_slope_of_a_power_law(self):
        self.assertAlmostEqual(slope([1.0, 2.0, 4.0], [3.0, 3.0 / 16, 3.0 / 256]), -4.0)
        self.assertTrue(math.isnan(slope([1.0, 2.0], [0.0, 1.0])))


class Verdicts(unittest.TestCase):
    def test_above_needs_a_clear_difference(self):
        low, near, high = Estimate(1.0, 0.1, 3), Estimate(1.2, 0.1, 3), Estimate(2.0, 0.1, 3)
        self.assertEqual(above(high, low), HOLDS)
        self.assertEqual(above(low, high), DOES_NOT_HOLD)
        self.assertEqual(above(near, low), NOT_RESOLVED)

    def test_above_without_errors_is_not_resolved(self):
        self.assertEqual(above(Estimate(2.0, math.nan, 1), Estimate(1.0, math.nan, 1)), NOT_RESOLVED)
        self.assertEqual(above(Estimate(math.nan, math.nan, 0), Estimate(1.0, 0.1, 3)), NOT_RESOLVED)

    def test_agrees_within(self):
        self.assertEqual(agrees(Estimate(-3.9, 0.1, 3), -4.0, 0.3), HOLDS)
        self.assertEqual(agrees(Estimate(-3.0, 0.1, 3), -4.0, 0.3), DOES_NOT_HOLD)
        self.assertEqual(agrees(Estimate(-3.0, 0.5, 3), -4.0, 0.3), NOT_RESOLVED)
        self.assertEqual(agrees(Estimate(-4.0, 2.0, 3), -4.0, 0.3), NOT_RESOLVED)

    def test_of_several_parts(self):
        self.assertEqual(all_of([HOLDS, HOLDS]), HOLDS)
        self.assertEqual(all_of([HOLDS, NOT_RESOLVED]), NOT_RESOLVED)
        self.assertEqual(all_of([NOT_RESOLVED, DOES_NOT_HOLD]), DOES_NOT_HOLD)
        self.assertEqual(all_of([]), NOT_RESOLVED)

    def test_a_claim_has_one_of_three_verdicts(self):
        with self.assertRaisesRegex(ValueError, "'maybe' is no verdict; they are: holds, does not hold, not resolved"):
            Claim("Water is wet.", "maybe", "")


if __name__ == "__main__":
    unittest.main()
