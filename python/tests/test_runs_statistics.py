"""Means in time and their errors, on series whose correlation is known."""

import math
import unittest

import numpy as np
import synthetic  # noqa: F401 finds the package

from mesogen.runs.statistics import block_error, correlation_samples, standard_error, time_mean

SAMPLES, INTERVAL = 4000, 2.0


def correlated(memory, chance, samples=SAMPLES):
    """x_n = memory x_{n-1} + noise of variance 1: correlation time (1 + memory) / (1 - memory) / 2 samples."""
    noise = chance.normal(size=samples) * math.sqrt(1.0 - memory**2)
    value = np.empty(samples)
    value[0] = chance.normal()
    for n in range(1, samples):
        value[n] = memory * value[n - 1] + noise[n]
    return value


class TimeMean(unittest.TestCase):
    def test_span_and_blocks(self):
        time = np.arange(0.0, 9.0)
        mean = time_mean(time, time**2, 2.0, 6.0, blocks=2)  # of 9, 16 and 25, 36
        self.assertEqual((mean.mean, mean.blocks), (21.5, 2))
        self.assertEqual(mean.error, 9.0)  # half the distance of 12.5 and 30.5
        self.assertEqual(block_error([1.0, 3.0, 2.0, 4.0, 6.0, 8.0], 3), standard_error([2.0, 3.0, 7.0]))

    def test_the_error_of_correlated_samples(self):
        time = np.arange(SAMPLES) * INTERVAL
        for memory in (0.0, 0.5, 0.9):
            chance = np.random.default_rng(7)
            means = [time_mean(time, correlated(memory, chance), -1.0, math.inf) for _ in range(100)]
            factor = (1.0 + memory) / (1.0 - memory)
            found = math.sqrt(np.mean([mean.error**2 for mean in means]))
            self.assertAlmostEqual(found / math.sqrt(factor / SAMPLES), 1.0, delta=0.08, msg=str(memory))
            self.assertAlmostEqual(np.mean([mean.correlation_time for mean in means]) / (0.5 * factor * INTERVAL), 1.0,
                                   delta=0.08, msg=str(memory))
            self.assertEqual({mean.problem for mean in means}, {""})

    def test_blocks_that_are_too_short(self):
        value = correlated(0.99, np.random.default_rng(3), 1000)
        mean = time_mean(np.arange(1000.0), value, -1.0, math.inf)
        self.assertEqual(mean.blocks, 4)
        self.assertRegex(mean.problem, r"^changes so slowly that 4 blocks are [\d.]+ correlation times each: "
                                       r"the error by blocks is too small$")
        self.assertEqual(time_mean(np.arange(1000.0), np.tile([0.0, 1.0], 500), -1.0, math.inf, blocks=7).problem, "")

    def test_what_is_not_known(self):
        time = np.arange(10.0)
        nothing = time_mean(time, time, 20.0, 30.0)
        self.assertEqual((nothing.known, nothing.problem),
                         (False, "has no sample after 20 s up to 30 s; the last is at 9 s"))
        self.assertEqual(time_mean(time, time, 20.0, 30.0, unit="ms").problem,
                         "has no sample after 20 ms up to 30 ms; the last is at 9 ms")
        self.assertEqual(time_mean(time, np.full(10, math.nan), 0.0, math.inf).problem, "is not a number in any sample")
        few = time_mean(time, time, 6.0, math.inf)
        self.assertEqual((few.mean, few.problem), (8.0, "has 3 samples, too few for 4 blocks"))
        self.assertTrue(math.isnan(few.error))
        holes = np.where(time == 4.0, math.nan, 1.0)
        some = time_mean(time, holes, -1.0, math.inf)
        self.assertEqual((some.mean, some.error, some.problem),
                         (1.0, 0.0, "is not a number in 1 of 10 samples, which are left out"))

    def test_series_without_correlation(self):
        self.assertEqual(correlation_samples(np.ones(50)), 0.5)
        self.assertEqual(correlation_samples([3.0]), 0.5)
        self.assertEqual(correlation_samples(np.tile([-1.0, 1.0], 50)), 0.5)


if __name__ == "__main__":
    unittest.main()
