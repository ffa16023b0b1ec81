"""chart: studies, from the file to the charts."""

import fcntl
import os
import pathlib
import re
import signal
import unittest

from chart_case import CASE, STUDY, ChartTest

FAILS = """\
[variant.runs_away]
resolutions = [8]
"time.factor" = 30.0
"time.end" = 20.0
"""


class Chart(ChartTest):
    def test_a_study_from_nothing_to_charts(self):
        out, err = self.chart()
        for name in ("error_cost", "error_resolution"):
            with open(self.path("out", name + ".png"), "rb") as file:
                self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")
            self.assertIn("</svg>", self.read("out", name + ".svg"))
        self.assertIn("14 of 14  wendland_c2 16 (2 of 2): error ", err)
        self.assertNotIn("\r", err)

        runs = self.runs()
        self.assertEqual([(run["variant"], run["resolution"], run["repeat"]) for run in runs[:4]],
                         [("default", "8", "1"), ("wendland_c2", "8", "1"), ("short", "8", "1"), ("default", "12", "1")])
        self.assertEqual(len(runs), 14)
        for run in runs:
            self.assertEqual(run["status"], "done")
            for column in ("error", "wall_seconds", "cpu_seconds", "steps", "peak_memory"):
                self.assertGreater(float(run[column]), 0.0, column)
        errors = {(run["variant"], run["resolution"]): float(run["error"]) for run in runs}
        self.assertLess(errors["default", "8"], 0.2)
        self.assertLess(errors["default", "16"], errors["default", "8"] / 2)
        self.assertEqual(errors["short", "8"], errors["default", "8"])

        table = self.read("out", "table.md")
        self.assertIn(table, out)
        self.assertIn("Scene: Shear wave. exact: v_rms = exp(-nu k^2 t) / sqrt(2)", table)
        self.assertRegex(table, r"Machine: .*\d core")
        self.assertRegex(table, r"Mesogen: mesogen \d+\.\d+\.\d+ \(")
        self.assertRegex(table, r"\| wendland_c2 \| +8 \| +[\d.]+ % \|.*another kernel")
        self.assertRegex(table, r"(?m)^\| +10 % \| (default|wendland_c2|short) ")
        self.assertEqual([(p["variant"], p["resolution"], p["runs"]) for p in self.table("out", "points.csv")],
                         [("default", "8", "2"), ("default", "12", "2"), ("default", "16", "2"), ("wendland_c2", "8", "2"),
                          ("wendland_c2", "12", "2"), ("wendland_c2", "16", "2"), ("short", "8", "2")])

        before = {name: pathlib.Path(self.path("out", name)).read_bytes()
                  for name in ("runs.csv", "error_cost.svg", "error_cost.png")}
        _, err = self.chart()
        self.assertEqual(err, "")
        for name, content in before.items():
            self.assertEqual(pathlib.Path(self.path("out", name)).read_bytes(), content, name)

    def test_list_runs_nothing(self):
        out, _ = self.chart("--list", "--only", "default")
        lines = out.splitlines()
        self.assertEqual(len(lines), 6)
        self.assertRegex(lines[0], r"^missing  default 8 \(1 of 2\): \S*mesogen run scene/case\.toml --set time\.factor=0\.5 "
                                   r"--set particles\.spacing=0\.125 --output out/run --threads 1$")
        self.assertFalse(os.path.exists(self.path("out")))

    def test_only_some_variants(self):
        self.chart("--only", "short,default", "--quiet")
        self.assertEqual({run["variant"] for run in self.runs()}, {"short", "default"})
        _, err = self.chart("--only", "defalt", code=2)
        self.assertEqual(err, "error: --only: no variant 'defalt' in study.toml; did you mean 'default'?\n")

    def test_draw_only(self):
        _, err = self.chart("--draw-only", code=2)
        self.assertEqual(err, "error: out: nothing has run yet; leave out --draw-only\n")
        self.chart("--only", "short")
        os.remove(self.path("out", "table.md"))
        out, err = self.chart("--draw-only")
        self.assertEqual((err, len(self.runs())), ("", 2))
        self.assertIn("wrote out/table.md", out)

    def test_a_killed_study_goes_on(self):
        self.write(STUDY.replace("[8, 12, 16]", "[8, 12, 40]"), "study.toml")
        study = self.start("chart", "study.toml", "--output", "out")
        while "default 12" not in study.stderr.readline():
            self.assertIsNone(study.poll())
        study.kill()
        study.communicate()
        with open(self.path("out", "runs.csv"), "a", encoding="utf-8") as file:
            file.write("a line that was being wri")
        kept = self.runs()[:-1]
        self.assertGreaterEqual(len(kept), 4)
        self.write(STUDY, "study.toml")
        self.chart()
        runs = self.runs()
        self.assertEqual(runs[: len(kept)], kept)
        self.assertEqual(len({(run["variant"], run["resolution"], run["repeat"]) for run in runs if run["resolution"] != "40"}), 14)

    def test_an_interrupted_study_stops_its_run(self):
        self.write(STUDY.replace("[8, 12, 16]", "[100]"), "study.toml")
        study = self.start("chart", "study.toml", "--output", "out")
        self.wait_for(study, "out", "run", "run.log")
        study.send_signal(signal.SIGTERM)
        _, err = study.communicate(timeout=30)
        self.assertEqual(study.returncode, 130)
        self.assertEqual(err, "interrupted: what was done is kept; the same command goes on\n")
        self.assertFalse(os.path.exists(self.path("out", "run")))

    def test_what_changed_runs_again(self):
        self.chart("--only", "short,default")
        before = self.runs()
        self.write(self.read("study.toml").replace('"time.end" = 0.2', '"time.end" = 0.2\n"time.factor" = 0.7'), "study.toml")
        _, err = self.chart("--only", "short,default")
        self.assertIn("short 8 runs again: the study, its case, its answer or a default of mesogen has changed\n", err)
        self.assertNotIn("default 8", err)
        self.assertEqual(len(self.runs()), len(before) + 2)

        self.write("# a remark changes nothing\n" + CASE, "scene/case.toml")
        self.assertEqual(self.chart("--only", "short,default")[1], "")
        self.write(CASE.replace("viscosity = 0.05", "viscosity = 0.06"), "scene/case.toml")
        self.assertIn("default 8 runs again", self.chart("--only", "short,default")[1])

    def test_runs_with_other_defaults_are_done_again(self):
        self.chart("--only", "short")
        self.assertNotIn("defaults", self.read("out", "table.md"))
        text = self.read("out", "runs.csv")
        self.assertEqual(text.count(", defaults "), 2)
        for other in (", defaults 0123456789ab", ""):  # of another version, or not told
            self.write(re.sub(", defaults [0-9a-f]+", other, text), "out/runs.csv")
            self.assertEqual(self.chart("--draw-only", "--only", "short", code=2)[1],
                             "error: out: nothing has run yet; leave out --draw-only\n")
            self.assertIn("short 8 runs again: ", self.chart("--only", "short")[1])
            self.assertEqual(len(self.runs()), 4)

    def test_a_failure_is_a_point(self):
        self.write(STUDY + FAILS, "study.toml")
        out, err = self.chart("--only", "short,runs_away")
        self.assertRegex(err, r"runs_away 8 \(1 of 2\): FAILED: the run (broke down|ran away)")
        failed = [run for run in self.runs() if run["variant"] == "runs_away"]
        self.assertEqual([(run["status"], run["error"]) for run in failed], [("failed", "")])  # not repeated
        self.assertRegex(failed[0]["reason"], r"^the run (broke down|ran away).* at t = ")
        self.assertRegex(out, r"\| runs_away \| +8 \| +\| .* FAILED +\|")
        self.assertRegex(out, r"\n- runs_away 8: the run (broke down|ran away)")
        self.assertEqual(self.chart("--only", "short,runs_away")[1], "")
        self.chart("--only", "runs_away")  # nothing to draw but a table

    def test_a_run_that_takes_too_long(self):
        study = STUDY.replace("repeats = 2", "repeats = 1\ntimeout = 0.5").replace("[8, 12, 16]", "[60]")
        self.write(study, "study.toml")
        out, _ = self.chart("--only", "default")
        self.assertEqual([(run["status"], run["reason"]) for run in self.runs()], [("timeout", "took longer than 0.5 s")])
        self.assertRegex(out, r"\n- \w+ 60: took longer than 0.5 s\n")
        self.assertEqual(self.chart("--only", "default")[1], "")
        self.write(study.replace("timeout = 0.5", "timeout = 600"), "study.toml")
        self.assertRegex(self.chart("--list", "--only", "default")[0], "^missing  default 60")

    def test_two_at_once_are_refused(self):
        os.mkdir(self.path("out"))
        with open(self.path("out", ".lock"), "w", encoding="ascii") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            _, err = self.chart(code=2)
        self.assertEqual(err, "error: another study is writing into out; choose another folder with --output, or wait\n")


if __name__ == "__main__":
    unittest.main()
