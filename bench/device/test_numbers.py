#!/usr/bin/python3
"""What scripts/device compares, judges and calculates, and which of it goes to docs/performance.md."""

import json
import sys
import unittest
from unittest import mock

from test_support import InFolder

import agreement
import counters
import device_figures
import h5py
import numpy
import roofline
import speed
import speed_runs
import speed_stages
from speed_tables import read_csv, row, write_csv
from verdicts import FAIL, NOT_RUN, PASS, Line, NotRun, Report, exit_code, read_report, summary


class Comparing(InFolder):
    def test_differences_are_relative_to_the_size_of_a_field(self):
        a = numpy.array([[[5.0, 1.0], [5.2, 1.0]]])  # a mean of 5.1, from which values deviate by 0.1
        self.assertAlmostEqual(agreement.relative_difference(a, a + [0.01, 0.0]), 0.1)
        self.assertEqual(agreement.relative_difference(a, a * numpy.nan), agreement.NO_NUMBER)
        self.assertEqual(agreement.relative_difference(a, a[:, :1]), agreement.NO_NUMBER)

    def test_bits_are_compared_by_dataset(self):
        for name, value in (("one", 1.0), ("other", 1.0 + 2**-52)):
            (self.folder / name).mkdir()
            with h5py.File(self.folder / name / "results.h5", "w") as file:
                file["same"] = [1, 2]
                file["text"] = name
                file["group/changed"] = [value]
                file.create_group("cost").attrs["seconds"] = value
                file[f"only {name}"] = [1.0]
        self.assertEqual(agreement.different_bits(self.folder / "one", self.folder / "other"),
                         ["results.h5:/group/changed", "results.h5:/only one", "results.h5:/only other"])
        self.assertEqual(agreement.different_bits(self.folder / "one", self.folder / "one"), [])


class Numbers(InFolder):
    def test_a_time_is_judged_by_its_goal(self):
        report = Report("speed", self.folder / "a.jsonl")
        with mock.patch("speed_stages.EMULATED", False):
            speed_stages.judge_time(report, "a", 0.2e-3, 0.3, 0.15)
            speed_stages.judge_time(report, "b", 0.4e-3, 0.3, 0.15)
            speed_stages.judge_time(report, "c", 0.4e-3)
        with mock.patch("speed_stages.EMULATED", True):
            speed_stages.judge_time(report, "d", 0.4e-3, 0.3, 0.15)
        lines, _ = read_report(report.file)
        self.assertEqual([line.verdict for line in lines], [PASS, FAIL, PASS, PASS])
        self.assertEqual([line.detail for line in lines], [
            "0.2 ms a step (goal 0.3, better 0.15: missed)", "0.4 ms a step (goal 0.3, better 0.15: missed)",
            "0.4 ms a step", "0.4 ms a step, not judged"])

    def test_the_time_of_a_step_is_read_in_the_log(self):
        log = "2026 info 20 steps in 0.0 s: 1.482 ms a step, 1.69e+06 particle-steps/s; neighbours sorted 1 times\n"
        seconds, steps = speed_runs.told_seconds(log)
        self.assertAlmostEqual(seconds, 1.482e-3)
        self.assertEqual(steps, 20)
        with self.assertRaisesRegex(SystemExit, "the log of a run tells no time of a step:\nnothing"):
            speed_runs.told_seconds("nothing")

    def test_progress_is_read_until_the_last_step(self):
        text = "100 %  t = 0.002 of 0.002 s  40 steps in 1 min 04 s  0.625 steps/s"
        seconds, _ = speed_stages.seconds_until_the_last_step(["sh", "-c", f"echo '{text}'; sleep 60"], self.folder)
        self.assertAlmostEqual(seconds, 1.6)
        self.assertEqual(speed_stages.seconds_until_the_last_step(["sh", "-c", "echo 'error: too large'"], self.folder),
                         (None, "error: too large"))

    def test_the_roofline_is_the_slower_of_arithmetic_and_memory(self):
        counted = {"neighbours": 50.0, "operations_a_pair": 40.0}
        self.assertEqual(roofline.least_seconds(counted, {"a": 2}, 1e6, 1e12, 1e12), (2e-3, "arithmetic"))
        self.assertEqual(roofline.least_seconds(counted, {"a": 2, "b": 3}, 1e6, 1e15, 1e10), (2e-3, "memory"))

    def test_passes_of_a_step_are_found_by_how_they_begin(self):
        counted = {name: {"neighbours": 50.0, "operations_a_pair": 40.0} for name, _ in roofline.PASSES.values()}
        lines = roofline.lines_of({"framework: volume": 4e-3, "framework: guard": 1.0}, counted, 1e6, 1e12, 1e12)
        self.assertEqual([(line["pass"], line["share"]) for line in lines], [("volume", 0.5)])
        with self.assertRaisesRegex(NotRun, "none of the parts of a step is a known sum over neighbours: framework: "
                                            "guard"):
            roofline.lines_of({"framework: guard": 1.0}, counted, 1e6, 1e12, 1e12)

    def test_counters_of_the_last_launch(self):
        name = "gpu__time_duration.sum"
        text = f'==PROF== told\n"ID","Kernel Name","{name}"\n"","","us"\n"0","run","5"\n"1","run","4.5"\n'
        self.assertEqual(counters.last_launch(text), {name: "4.5 us"})
        self.assertEqual(counters.last_launch("==ERROR== nothing"), {})

    def test_a_table_of_all_verdicts(self):
        text = summary([Line("a", "b|c", PASS, "two\nlines"), Line("d", "e", NOT_RUN, "why")], "On a card.")
        self.assertEqual(text.splitlines(), [
            "# scripts/device", "", "On a card.", "",
            "| stage | what | verdict | detail |", "| --- | --- | --- | --- |",
            "| a | b/c | PASS | two lines |", "| d | e | NOT RUN | why |", "", "1 PASS, 0 FAIL, 1 NOT RUN"])
        self.assertEqual(exit_code([Line("a", "b", NOT_RUN)]), 3)
        self.assertEqual(exit_code([]), 1)


class Page(InFolder):
    def results(self, **changed):
        figure = ["device", "250,000", "ms a step, single", 0.25]
        self.write(json.dumps({"emulated": False, "figures": [figure], **changed}), "results.json")
        return device_figures.read_results(self.folder)

    def test_figures_of_a_device_are_taken(self):
        self.assertEqual(self.results(), row("device", "250,000", {"ms a step, single": 0.25}))

    def test_the_page_takes_the_tables_of_a_device(self):
        before = device_figures.NOT_MEASURED
        self.write("".join(f"<!-- measured: {name} -->\n{before}\n<!-- end -->\n"
                           for name in (*speed.CORNERS, speed.MACHINE)), "pages.md")
        kept = row("sizes", "10,000", {"ms": 1.5}) + row(speed.MACHINE, "machine", {"": "A machine."})
        (self.folder / "pages").mkdir()
        write_csv(self.folder / "pages/speed.csv", kept + row("device", "250,000", {"ms a step, single": 9.0}))
        self.results()
        with mock.patch.object(sys, "argv", ["speed.py", "--device-results", str(self.folder), "-o",
                                             str(self.folder / "pages")]):
            speed.main()
        page = (self.folder / "pages.md").read_text(encoding="utf-8")
        self.assertIn("| particles on the device | ms a step, single |\n| --- | --- |\n| 250,000 | 0.25 |\n", page)
        self.assertIn("| particles | ms |\n| --- | --- |\n| 10,000 | 1.5 |\n", page)
        self.assertIn(f"<!-- measured: device roofline -->\n{before}\n", page)
        self.assertEqual(read_csv(self.folder / "pages/speed.csv"), kept + row("device", "250,000",
                                                                              {"ms a step, single": 0.25}))

    def test_what_is_refused(self):
        with self.assertRaisesRegex(SystemExit, "there is no such file; --device-results takes the folder OUT that"):
            device_figures.read_results(self.folder)
        with self.assertRaisesRegex(SystemExit, "was made by the emulated device, whose times say nothing of a GPU; "
                                                "run"):
            self.results(emulated=True)
        with self.assertRaisesRegex(SystemExit, "holds no measurements; the stages of speed passed on no device, see"):
            self.results(figures=[])

    def test_the_page_says_so_until_a_device_was_measured(self):
        page = (speed_runs.PROJECT / "docs/performance.md").read_text(encoding="utf-8")
        csv = (speed_runs.PROJECT / "docs/performance/speed.csv").read_text(encoding="utf-8")
        for table in device_figures.TABLES:
            block = page.split(f"<!-- measured: {table} -->\n")[1].split("<!-- end -->")[0]
            self.assertEqual(block == device_figures.NOT_MEASURED + "\n", f"\n{table}," not in csv, table)


if __name__ == "__main__":
    unittest.main()
