"""Estimates over seeds and blocks, their text in tables, and options of sbatch."""

import math
import unittest

import synthetic  # noqa: F401 finds the package

from mesogen.runs.statistics import Mean
from mesogen.sweep.collection import Estimate, estimate
from mesogen.sweep.slurm import _option_lines
from mesogen.sweep.tables import estimate_text


class Estimates(unittest.TestCase):
    def test_over_seeds(self):
        found = estimate([Mean(1.0, 0.3, 6, 2.0), Mean(2.0, 0.4, 6, 2.0)])
        self.assertEqual((found.mean, found.over), (1.5, "seeds"))
        self.assertAlmostEqual(found.error, 0.5, delta=1e-15)
        self.assertAlmostEqual(found.block_error, 0.25, delta=1e-15)  # half of sqrt(0.3^2 + 0.4^2)

    def test_over_blocks(self):
        nothing = Mean(math.nan, math.nan, 0, math.nan, "has no sample")
        found = estimate([nothing, Mean(1.0, 0.3, 6, 2.0)])
        self.assertEqual((found.mean, found.error, found.over, found.block_error), (1.0, 0.3, "blocks", 0.3))
        self.assertEqual(estimate([Mean(1.0, math.nan, 0, 2.0)]).over, "")
        self.assertTrue(math.isnan(estimate([nothing]).mean))

    def test_estimates_show_two_digits_of_their_error(self):
        nan = float("nan")
        for numbers, text in (((0.15841, 0.00052, "seeds"), "0.15841 ± 0.00052 (seeds)"),
                              ((1234.5, 12.0, "blocks"), "1234 ± 12 (blocks)"),
                              ((0.5, 0.0, "seeds"), "0.500000 ± 0.000000 (seeds)"),
                              ((0.0, 0.0, "seeds"), "0 ± 0 (seeds)"), ((2.0, nan, ""), "2"), ((nan, nan, ""), "")):
            self.assertEqual(estimate_text(Estimate(*numbers, float("nan"))), text)


class SlurmOptions(unittest.TestCase):
    def test_options_of_sbatch(self):
        self.assertEqual(_option_lines("--time=1:00 -p long  --comment 'a b'"), ["--time=1:00", "-p long", "--comment 'a b'"])


if __name__ == "__main__":
    unittest.main()
