"""The error of a run, on series whose answer is known."""

import math
import unittest

import numpy as np
import synthetic

import mesogen
from mesogen.charts import measures
from mesogen.charts.scene import Quantity
from mesogen.errors import StudyError

TIME = np.arange(0.0, 10.5, 0.5) + 0.01  # as observers sample: a little after their time


def known(measure, at, exact, scale=None, column="v_rms"):
    return Quantity("flow", column, measure, tuple(at), tuple(exact), scale)


class Measures(synthetic.FolderTest):
    def recorded(self, values):
        results = synthetic.Results(self.folder)
        results.observable("flow", "v_rms", "m/s", values, steps=np.arange(len(TIME)), times=TIME)
        run = mesogen.open(results.close())
        self.addCleanup(run.close)
        return run

    def test_value_between_samples(self):
        run = self.recorded(np.exp(-0.1 * TIME))
        self.assertLess(measures.error(run, [known("value", [2.0, 5.25], np.exp([-0.2, -0.525]))]), 1e-6)

    def test_errors_are_relative_and_their_mean_square_is_taken(self):
        run = self.recorded(np.full(len(TIME), 1.1))
        answer = [known("value", [1.0, 2.0], [1.0, 1.1]), known("value", [3.0], [0.1], scale=2.0)]
        self.assertAlmostEqual(measures.error(run, answer), math.sqrt((0.1**2 + 0 + 0.5**2) / 3), 12)

    def test_growth_rate(self):
        run = self.recorded(3.0 * np.exp(0.2 * TIME))
        self.assertAlmostEqual(measures.growth_rate(run, known("growth_rate", [1, 9], [0.2]))[0], 0.2, 12)
        self.assertAlmostEqual(measures.error(run, [known("growth_rate", [1, 9], [0.25])]), 0.2, 12)

    def test_growth_rate_takes_only_its_span(self):
        run = self.recorded(np.exp(np.where(TIME < 5, 0.3 * TIME, 1.5)))
        self.assertAlmostEqual(measures.growth_rate(run, known("growth_rate", [0, 4.6], [0.3]))[0], 0.3, 12)

    def refusal(self, quantity, values=None):
        with self.assertRaises(StudyError) as raised:
            measures.error(self.recorded(np.ones(len(TIME)) if values is None else values), [quantity])
        return str(raised.exception)

    def test_beyond_the_run(self):
        self.assertEqual(self.refusal(known("value", [20.0], [1.0])),
                         "the answer is for t = 20 s, but the series was recorded from t = 0.01 to 10.01 s")

    def test_no_growth_rate_of_one_sample(self):
        self.assertEqual(self.refusal(known("growth_rate", [0.0, 0.2], [1.0])),
                         "flow.v_rms has 1 samples from t = 0 to 0.2 s, and a growth rate needs two: let the observer "
                         "sample oftener")

    def test_no_growth_rate_beyond_the_series(self):
        self.assertEqual(self.refusal(known("growth_rate", [1.0, 20.0], [1.0])),
                         "the answer is for t = 1 to 20 s, but flow.v_rms was recorded from t = 0.01 to 10.01 s")

    def test_no_growth_rate_of_what_is_zero(self):
        self.assertEqual(self.refusal(known("growth_rate", [0.0, 5.0], [1.0]), np.zeros(len(TIME))),
                         "flow.v_rms is not above 0 from t = 0 to 5 s: it has no growth rate")

    def test_a_quantity_that_nobody_recorded(self):
        with self.assertRaises(mesogen.NoSuchName) as raised:
            measures.error(self.recorded(np.ones(len(TIME))), [known("value", [1.0], [1.0], column="speed")])
        self.assert_text(raised, "no quantity 'speed' in observer 'flow'", "there are: v_rms")


class Interpolation(unittest.TestCase):
    def test_is_exact_for_cubics(self):
        time = np.array([0.0, 0.7, 1.0, 2.2, 3.0, 4.5])
        cubic = np.polynomial.Polynomial([1.0, -2.0, 0.5, 0.25])
        for at in (0.1, 0.8, 1.5, 2.9, 4.4, 4.5):
            self.assertAlmostEqual(measures.interpolate(time, cubic(time), at), cubic(at), 12)

    def test_of_few_samples(self):
        self.assertEqual(measures.interpolate(np.array([0.0, 2.0]), np.array([1.0, 3.0]), 1.0), 2.0)
        with self.assertRaisesRegex(StudyError, r"^the answer is for t = 5 ms, but the series was recorded from t = 0 to 2 ms$"):
            measures.interpolate(np.array([0.0, 2.0]), np.array([1.0, 3.0]), 5.0, "ms")
        self.assertEqual(measures.interpolate(np.array([1.0]), np.array([4.0]), 1.0), 4.0)


if __name__ == "__main__":
    unittest.main()
