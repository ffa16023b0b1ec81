"""Finding boundaries by bisection, on rules that are known."""

import math
import unittest

from mesogen.charts.search import Sweep, boundaries, next_value


def found(sweep, rule):
    """{value: whether it held} of all that the search tries where `rule` tells."""
    holds = {}
    while (value := next_value(sweep, holds)) is not None:
        if value in holds:
            raise AssertionError(f"{value} is tried twice")
        holds[value] = rule(value)
    return holds


class Search(unittest.TestCase):
    def test_finds_a_boundary_on_a_log_scale(self):
        sweep = Sweep(0.5, 32.0, True, 0.05)
        holds = found(sweep, lambda x: x < 4.2)
        ((inside, outside),) = boundaries(holds)
        self.assertTrue(inside < 4.2 <= outside)
        self.assertLessEqual(outside / inside, 1.05)
        self.assertLessEqual(len(holds), sweep.most_trials())

    def test_finds_a_boundary_on_a_linear_scale(self):
        sweep = Sweep(-0.02, -0.25, False, 0.01)
        ((inside, outside),) = boundaries(found(sweep, lambda x: x > -0.1))
        self.assertTrue(outside <= -0.1 < inside)
        self.assertLessEqual(inside - outside, 0.01)

    def test_the_end_that_fails_may_be_either(self):
        for rule in (lambda x: x < 5, lambda x: x >= 5):
            ((inside, outside),) = boundaries(found(Sweep(1.0, 10.0, False, 0.1), rule))
            self.assertEqual(inside < outside, rule(1.0))

    def test_both_ends_are_tried_and_no_more_if_they_agree(self):
        for held in (True, False):
            holds = found(Sweep(1.0, 10.0, False, 0.1), lambda x, held=held: held)
            self.assertEqual(holds, {1.0: held, 10.0: held})
            self.assertEqual(boundaries(holds), [])

    def test_a_grid_shows_what_lies_between_the_ends(self):
        window = lambda x: 8 < x < 16  # noqa: E731
        self.assertEqual(boundaries(found(Sweep(2.0, 50.0, True, 0.05), window)), [])
        low, high = boundaries(found(Sweep(2.0, 50.0, True, 0.05, points=6), window))
        self.assertTrue(low[1] <= 8 < low[0] and high[0] < 16 <= high[1])

    def test_a_search_goes_on_where_it_was(self):
        sweep = Sweep(1.0, 100.0, True, 0.01)
        whole = found(sweep, lambda x: x < 30)
        for count in range(len(whole)):
            known = dict(list(whole.items())[:count])
            self.assertEqual(next_value(sweep, known), list(whole)[count])

    def test_values_are_short_but_never_stick(self):
        self.assertEqual(Sweep(1.0, 3.0, True, 0.1).middle(1.0, 3.0), 1.732)
        sweep = Sweep(1.0, 1.001, False, 1e-9)
        ((inside, outside),) = boundaries(found(sweep, lambda x: x < 1.0 + math.pi * 1e-4))
        self.assertTrue(inside < 1.0 + math.pi * 1e-4 <= outside)
        self.assertLessEqual(outside - inside, 1e-9)


if __name__ == "__main__":
    unittest.main()
