"""Means, errors and the verdicts that they allow."""

import math
import unittest

from mesogen.study import (DOES_NOT_HOLD, HOLDS, NOT_RESOLVED, Claim, Estimate, above, agrees, decided, exponent, over_seeds,
                            ratio)
from mesogen.study.estimate import difference, student
from mesogen.study.verdict import all_of


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
        self.assertEqual(Estimate(0.95, 8e-17, 3).text(), "0.950000 ± 0.000000")

    def test_exponent_of_a_power_law(self):
        found = exponent([1.0, 2.0, 4.0], [Estimate(3.0 / 16**n, 0.0, 3) for n in range(3)])
        self.assertAlmostEqual(found.mean, -4.0)
        self.assertEqual(found.error, 0.0)
        # Of two points it is the slope of a line: errors of 1 and 2 % over ln 4.
        found = exponent([1.0, 4.0], [Estimate(2.0, 0.02, 3), Estimate(4.0, 0.08, 3)])
        self.assertAlmostEqual(found.mean, 0.5)
        self.assertAlmostEqual(found.error, math.hypot(0.01, 0.02) / math.log(4.0))
        with self.assertRaisesRegex(ValueError, "two points or more"):
            exponent([1.0], [Estimate(1.0, 0.0, 3)])

    def test_student_is_that_of_the_tables(self):
        for freedom, t in ((1, 12.706), (2, 4.303), (4, 2.776), (10, 2.228), (30, 2.042), (1e9, 1.960)):
            self.assertAlmostEqual(student(freedom), t, delta=0.01)
        self.assertTrue(math.isnan(student(0)))

    def test_combinations(self):
        found = difference(Estimate(3.0, 0.3, 3), Estimate(1.0, 0.4, 3))
        self.assertEqual(found.mean, 2.0)
        self.assertAlmostEqual(found.error, 0.5)
        self.assertAlmostEqual(found.count, 1 + 0.5**4 / (0.3**4 / 2 + 0.4**4 / 2))  # Welch and Satterthwaite
        self.assertAlmostEqual(difference(Estimate(1.0, 0.1, 3), Estimate(0.0, 0.1, 3)).count, 5.0)
        self.assertAlmostEqual(difference(Estimate(1.0, 0.1, 3), Estimate(0.0, 0.0, 1)).count, 3.0)
        found = ratio(Estimate(6.0, 0.3, 3), Estimate(2.0, 0.1, 3))
        self.assertAlmostEqual(found.mean, 3.0)
        self.assertAlmostEqual(found.error, 3.0 * math.hypot(0.05, 0.05))


class Verdicts(unittest.TestCase):
    def test_above_needs_a_clear_difference(self):
        low, near, high = Estimate(1.0, 0.1, 3), Estimate(1.2, 0.1, 3), Estimate(2.0, 0.1, 3)
        self.assertEqual(above(high, low), HOLDS)
        self.assertEqual(above(low, high), DOES_NOT_HOLD)
        self.assertEqual(above(near, low), NOT_RESOLVED)

    def test_two_seeds_say_less_than_five(self):
        for count, verdict in ((2, NOT_RESOLVED), (5, HOLDS)):
            self.assertEqual(above(Estimate(1.4, 0.1, count), Estimate(1.0, 0.1, count)), verdict)
        exact = Estimate(0.0, 0.0, 1)
        self.assertEqual(above(Estimate(0.4, 0.1, 3), exact), NOT_RESOLVED)
        self.assertEqual(above(Estimate(0.5, 0.1, 3), exact), HOLDS)

    def test_what_is_not_known_decides_nothing(self):
        self.assertEqual(decided(True, 1.0), HOLDS)
        self.assertEqual(decided(False, 1.0), DOES_NOT_HOLD)
        self.assertEqual(decided(False, 1.0, math.nan), NOT_RESOLVED)

    def test_above_without_errors_is_not_resolved(self):
        self.assertEqual(above(Estimate(2.0, math.nan, 1), Estimate(1.0, math.nan, 1)), NOT_RESOLVED)
        self.assertEqual(above(Estimate(math.nan, math.nan, 0), Estimate(1.0, 0.1, 3)), NOT_RESOLVED)

    def test_agrees_within(self):
        self.assertEqual(agrees(Estimate(-3.9, 0.04, 3), -4.0, 0.3), HOLDS)
        self.assertEqual(agrees(Estimate(-3.9, 0.06, 3), -4.0, 0.3), NOT_RESOLVED)  # 4.3 errors of three seeds: 0.26
        self.assertEqual(agrees(Estimate(-3.9, 0.06, 11), -4.0, 0.3), HOLDS)
        self.assertEqual(agrees(Estimate(-3.0, 0.1, 3), -4.0, 0.3), DOES_NOT_HOLD)
        self.assertEqual(agrees(Estimate(-4.0, math.nan, 1), -4.0, 0.3), NOT_RESOLVED)
        self.assertEqual(agrees(Estimate(-3.0, 0.5, 3), -4.0, 0.3), NOT_RESOLVED)
        self.assertEqual(agrees(Estimate(-4.0, 2.0, 3), -4.0, 0.3), NOT_RESOLVED)

    def test_of_several_parts(self):
        self.assertEqual(all_of([HOLDS, HOLDS]), HOLDS)
        self.assertEqual(all_of([HOLDS, NOT_RESOLVED]), NOT_RESOLVED)
        self.assertEqual(all_of([NOT_RESOLVED, DOES_NOT_HOLD]), DOES_NOT_HOLD)
        self.assertEqual(all_of([]), NOT_RESOLVED)

    def test_a_claim_has_one_of_three_verdicts(self):
        with self.assertRaisesRegex(ValueError, "'maybe' is no verdict; they are: holds, does not hold, not resolved; above"):
            Claim("Water is wet.", "maybe", "")


if __name__ == "__main__":
    unittest.main()
