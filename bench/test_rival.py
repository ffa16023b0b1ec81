#!/usr/bin/python3
"""What bench/rival.py makes of its measurements."""

import csv
import math
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import rival  # noqa: E402
from rival import RIVAL, Result  # noqa: E402

FOUND = [
    Result("WCSPH", 16, 1.0, 100, 0.20), Result("WCSPH", 32, 8.0, 400, 0.05), Result("WCSPH", 64, 64.0, 1600, 0.005),
    Result("WCSPH", 128, 512.0, 6400, source="check"),
    Result(RIVAL, 16, 0.5, 256, 0.10, 0.25, 0.5), Result(RIVAL, 32, 2.0, 256, 0.025, 0.25, 0.5),
    Result(RIVAL, 64, 8.0, 256, 0.00625, 0.25, 0.5), Result(RIVAL, 128, 1024.0, 512, 0.00625, 0.25, 0.5),
]


class SpeedUp(unittest.TestCase):
    def test_error_is_that_of_all_times(self):
        exact = dict(rival.V_RMS)
        self.assertEqual(rival.relative_error(exact), 0.0)
        exact[30.0] *= 1.03
        self.assertAlmostEqual(rival.relative_error(exact), 0.03 / math.sqrt(3.0), places=12)

    def test_at_equal_resolution_predictions_count(self):
        self.assertEqual(rival.at_equal_resolution(FOUND, "WCSPH"), {16: 0.5, 32: 0.25, 64: 0.125, 128: 2.0})

    def test_at_equal_error_only_between_what_was_measured(self):
        """0.2 is beyond the coarsest grid; 0.05 lies halfway, in logarithms; 0.005 no grid reaches."""
        found = rival.at_equal_error(FOUND, "WCSPH")
        self.assertEqual(sorted(found), [32, 64])
        self.assertAlmostEqual(found[32][0], 1.0 / 8.0, places=12)
        self.assertFalse(found[32][1])
        self.assertEqual(found[64], (16.0, True))

    def test_the_median_counts_and_long_runs_are_not_repeated(self):
        times = iter([3.0, 1.0, 2.0, 30.0, 1.0])
        def one():
            return Result("WCSPH", 16, next(times), 1)
        self.assertEqual(rival.median_of(one, 3).seconds, 2.0)
        self.assertEqual(rival.median_of(one, 3).seconds, 30.0)


class Output(unittest.TestCase):
    def test_the_page(self):
        text = rival.page(FOUND, 1, "a machine", "a version")
        self.assertIn("processor time of stepping; a machine; a version.", text)
        lines = [" ".join(line.split()) for line in text.splitlines()]
        self.assertIn("| WCSPH | 128 | | 512 (predicted) | 6400 | | |", lines)
        self.assertIn(f"| {RIVAL} | 32 | 2.5 % | 2 | 256 | 25 % | 50 % |", lines)
        self.assertIn("| 64 | 0.125 | > 16 | | | | |", lines)
        self.assertIn("Mesogen with 2 threads", rival.page(FOUND, 2, "", ""))

    def test_files(self):
        with tempfile.TemporaryDirectory() as folder:
            name = pathlib.Path(folder) / "rival"
            rival.write_csv(FOUND, name.with_suffix(".csv"))
            with open(name.with_suffix(".csv"), newline="", encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
            rival.draw(FOUND, 1, name.with_suffix(".png"))
            first = name.with_suffix(".png").read_bytes()
            rival.draw(FOUND, 1, name.with_suffix(".png"))
            self.assertEqual(first, name.with_suffix(".png").read_bytes())
        self.assertEqual(len(rows), len(FOUND))
        self.assertEqual(rows[3], {"variant": "WCSPH", "across": "128", "seconds": "512", "steps": "6400", "error": "",
                                   "pressure": "", "diffusion": "", "source": "check"})


if __name__ == "__main__":
    unittest.main()
