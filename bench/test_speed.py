#!/usr/bin/python3
"""What bench/speed.py makes of its measurements; and that docs/performance.md shows docs/performance/speed.csv."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import speed  # noqa: E402
import speed_runs  # noqa: E402
from speed_tables import Figure, markdown, put_into, read_csv, row, write_csv  # noqa: E402

FIGURES = row("sizes", "10,000", {"ms": 1.23456, "note": "fast"}) + row("sizes", "40,000", {"ms": 4.0})
FIGURES += row("other", "10,000", {"ms": 7.0})


class Tables(unittest.TestCase):
    def test_a_table_is_a_pivot(self):
        self.assertEqual(markdown(FIGURES, "sizes", "particles"),
                         "| particles | ms | note |\n| --- | --- | --- |\n| 10,000 | 1.23 | fast |\n| 40,000 | 4 |  |")

    def test_a_csv_gives_the_same_table(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "speed.csv"
            write_csv(file, FIGURES)
            again = read_csv(file)
        self.assertEqual(again[0], Figure("sizes", "10,000", "ms", 1.23456))
        self.assertEqual(markdown(again, "sizes", "x"), markdown(FIGURES, "sizes", "x"))

    def test_a_page_takes_tables_between_its_markers(self):
        page = "before\n<!-- measured: a -->\nold\n<!-- end -->\nbetween\n<!-- measured: b -->\n<!-- end -->\n"
        self.assertEqual(put_into(page, {"a": "new", "b": r"\1"}),
                         "before\n<!-- measured: a -->\nnew\n<!-- end -->\n"
                         "between\n<!-- measured: b -->\n\\1\n<!-- end -->\n")

    def test_a_page_without_the_marker_is_refused(self):
        with self.assertRaisesRegex(ValueError, "the page has 0 places for the table 'a': it needs one, <!-- meas"):
            put_into("nothing", {"a": "new"})


class Traces(unittest.TestCase):
    def event(self, name, begin, duration):
        return {"name": name, "ph": "X", "ts": begin, "dur": duration}

    def test_a_run_is_its_median_step_and_the_passes_within(self):
        events = [self.event("framework: neighbours, sorting", 0.0, 500.0), self.event("p: pass", 600.0, 50.0)]
        for n, duration in enumerate((900.0, 900.0, 100.0, 100.0, 400.0)):  # the first two are skipped
            begin = 1000.0 * (n + 1)
            events += [self.event("framework: step", begin, duration), self.event("p: pass", begin + 1.0, 30.0),
                       self.event("output: frame", begin + duration + 1.0, 70.0)]
        run = speed_runs.Run({"traceEvents": events})
        self.assertAlmostEqual(run.step, 100e-6)
        self.assertAlmostEqual(run.sorting, 500e-6)
        self.assertEqual(list(run.shares), ["p: pass"])
        self.assertAlmostEqual(run.shares["p: pass"], 30e-6)

    def test_the_papers_scene_has_no_observers_left(self):
        text = speed_runs.paper_case()
        self.assertNotIn("[observers", text)
        for section in ("[physics.activity]", "[time]", "[output]", "[run]"):
            self.assertIn(section, text)


class Page(unittest.TestCase):
    def test_the_page_shows_what_was_measured(self):
        page = (speed_runs.PROJECT / "docs/performance.md").read_text(encoding="utf-8")
        figures = read_csv(speed_runs.PROJECT / "docs/performance/speed.csv")
        self.assertEqual(put_into(page, speed.tables(figures)), page, "run bench/speed.py --tables")


if __name__ == "__main__":
    unittest.main()
