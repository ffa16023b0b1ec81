"""Front, order, cost of an error and medians, on made-up points."""

import math
import unittest

from mesogen.charts import analysis, points
from mesogen.charts.expectation import expected_left, expected_seconds


def point(variant, resolution, error, wall, failure=""):
    return points.Point(variant, resolution, math.nan if failure else error, wall, wall, wall, wall, 10, 1e6, 1, failure)


def power(variant, order, scale, resolutions=(10, 20, 40), cost=3):
    """Errors scale * N^-order at N^cost seconds."""
    return [point(variant, n, scale * n**-order, n**cost * 1e-3) for n in resolutions]


class Front(unittest.TestCase):
    def test_keeps_what_nobody_beats(self):
        a, b, c, d, e = (point(*p) for p in (("a", 1, 0.5, 1), ("b", 1, 0.2, 2), ("c", 1, 0.3, 3), ("d", 1, 0.2, 4),
                                             ("e", 1, 0.1, 5)))
        self.assertEqual(analysis.front([e, d, c, b, a]), [a, b, e])

    def test_of_equal_points_one(self):
        self.assertEqual(len(analysis.front([point("a", 1, 0.5, 1), point("b", 1, 0.5, 1)])), 1)

    def test_equally_cheap_the_better(self):
        self.assertEqual([p.variant for p in analysis.front([point("a", 1, 0.5, 1), point("b", 1, 0.4, 1)])], ["b"])


class Order(unittest.TestCase):
    def test_of_a_power(self):
        self.assertAlmostEqual(analysis.order(power("a", 2.0, 3.0)), 2.0, 12)

    def test_of_scattered_points_is_the_least_squares_slope(self):
        errors = {10: 0.1, 20: 0.02, 40: 0.01}  # symmetric about N = 20: the slope of the outer two
        found = analysis.order([point("a", n, e, 1) for n, e in errors.items()])
        self.assertAlmostEqual(found, math.log(10) / math.log(4), 12)

    def test_failures_do_not_count(self):
        self.assertAlmostEqual(analysis.order([*power("a", 1.0, 1.0), point("a", 80, 0, 1, "broke down")]), 1.0, 12)

    def test_one_point_has_none(self):
        self.assertTrue(math.isnan(analysis.order([point("a", 10, 0.1, 1)])))


class Reach(unittest.TestCase):
    def test_interpolates_in_the_logarithms(self):
        found = analysis.reach(power("a", 2.0, 1.0), 1 / 30**2)  # between 20 and 40: exactly N = 30
        self.assertEqual(found.between, (20, 40))
        self.assertAlmostEqual(found.wall, 27.0, 9)

    def test_never_extrapolates(self):
        self.assertIsNone(analysis.reach(power("a", 2.0, 1.0), 0.9 / 40**2))
        found = analysis.reach(power("a", 2.0, 1.0), 0.5)
        self.assertEqual((found.between, found.wall), ((10,), 1.0))

    def test_a_measured_point_at_the_level(self):
        found = analysis.reach(power("a", 2.0, 1.0), 1 / 20**2)
        self.assertEqual((found.between, found.wall), ((20,), 8.0))

    def test_a_lucky_coarse_run_does_not_count(self):
        lucky = [point("a", 10, 0.001, 1), point("a", 20, 0.1, 8), point("a", 40, 0.004, 64)]
        self.assertIsNone(analysis.reach(lucky, 0.003))
        self.assertEqual(analysis.reach(lucky, 0.01).between, (20, 40))

    def test_a_finer_run_that_is_cheaper(self):
        found = analysis.reach([point("a", 10, 0.2, 1), point("a", 20, 0.05, 9), point("a", 40, 0.04, 2)], 0.05)
        self.assertEqual((found.between, found.wall), ((40,), 2))

    def test_failures_do_not_count(self):
        self.assertIsNone(analysis.reach([point("a", 10, 0, 1, "broke down")], 0.1))

    def test_cheapest_of_all(self):
        fast, slow = power("fast", 1.0, 1.0, cost=2), power("exact", 3.0, 200.0)
        self.assertEqual(analysis.cheapest(fast + slow, 0.05).variant, "fast")
        self.assertEqual(analysis.cheapest(fast + slow, 0.01).variant, "exact")
        self.assertIsNone(analysis.cheapest(fast + slow, 1e-5))


def row(**changes):
    return {"variant": "a", "resolution": "10", "status": "done", "reason": "", "error": "0.1", "wall_seconds": "1.0",
            "cpu_seconds": "2.0", "steps": "30", "peak_memory": "4e6", **changes}


class Points(unittest.TestCase):
    def test_medians(self):
        (found,) = points.points_of([row(wall_seconds=wall, error=error)
                                     for wall, error in (("1.0", "0.1"), ("5.0", "0.3"), ("2.0", "0.2"))])
        self.assertEqual((found.wall, found.wall_low, found.wall_high, found.error, found.runs), (2.0, 1.0, 5.0, 0.2, 3))
        self.assertEqual((found.cpu, found.steps, found.memory), (2.0, 30, 4e6))
        self.assertFalse(found.failed)

    def test_one_failure_fails_the_point(self):
        (found,) = points.points_of([row(), row(status="failed", reason="broke down", error="", steps="", peak_memory="",
                                                wall_seconds="0.25")])
        self.assertEqual((found.failure, found.wall), ("broke down", 0.25))
        self.assertTrue(math.isnan(found.error))

    def test_each_variant_and_resolution_is_one(self):
        found = points.points_of([row(), row(variant="b"), row(resolution="20"), row()])
        self.assertEqual([(p.variant, p.resolution, p.runs) for p in found], [("a", 10, 2), ("b", 10, 1), ("a", 20, 1)])


class Expectation(unittest.TestCase):
    known = {("a", 10): [1.0, 3.0, 2.0], ("a", 20): [20.0], ("b", 20): [30.0]}

    def test_own_time_first(self):
        self.assertEqual(expected_seconds("a", 10, self.known), 2.0)

    def test_else_the_nearest_resolution_of_the_variant(self):
        self.assertAlmostEqual(expected_seconds("b", 40, self.known), 30.0 * 2**3.5)

    def test_else_of_all(self):
        self.assertEqual(expected_seconds("c", 20, self.known), 25.0)
        self.assertIsNone(expected_seconds("c", 20, {}))

    def test_sum(self):
        self.assertEqual(expected_left([("a", 10), ("a", 20), ("a", 10)], self.known), 24.0)
        self.assertIsNone(expected_left([("a", 10)], {}))


if __name__ == "__main__":
    unittest.main()
