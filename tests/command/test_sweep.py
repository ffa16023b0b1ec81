"""sweep: from the file to the tables, broken off and gone on with."""

import fcntl
import math
import os
import pathlib
import re
import signal
import statistics
import sys
import time
import unittest

from support import MESOGEN, PROJECT
from sweep_case import CASE, LONGER, RUNS_AWAY, SWEEP, SweepTest

sys.path.insert(0, os.path.join(PROJECT, "python"))
import mesogen  # noqa: E402
import mesogen.sweep  # noqa: E402

LABELS = [f"{point}-seed_{seed}" for seed in (1, 2) for point in ("activity_0.05", "activity_-0.05", "thick")]
ONE_LONG = SWEEP.replace("[1, 2]", "[1]").replace('[point.thick]\n"physics.flow.viscosity" = 1.0\n', "")


class Sweep(SweepTest):
    def wait_for(self, process, *parts):
        deadline = time.time() + 60
        while not os.path.exists(self.path("out", *parts)):
            self.assertLess(time.time(), deadline)
            self.assertIsNone(process.poll(), parts)
            time.sleep(0.005)

    def test_seeds_of_a_case_that_leaves_its_seed_to_the_default(self):
        self.write(CASE.replace("seed = 1\n", ""), "case.toml")
        self.write(SWEEP.replace('[0.05, -0.05]', "[0.05]").replace('[point.thick]\n"physics.flow.viscosity" = 1.0\n', ""),
                   "sweep.toml")
        self.sweep("--quiet")
        for seed in (1, 2):
            with mesogen.open(self.path("out", "runs", f"activity_0.05-seed_{seed}")) as run:
                self.assertEqual(run.parameters["director"]["seed"], seed)

    def test_a_sweep_from_nothing_to_tables(self):
        out, err = self.sweep()
        self.assertRegex(err, r"6 of 6  \S+-seed_2: done, ")
        self.assertNotIn("\r", err)

        values = self.table("out", "values.csv")
        self.assertEqual([value["run"] for value in values], LABELS)
        means = {}
        for value in values:
            with mesogen.open(self.path("out", "runs", value["run"])) as run:
                self.assertEqual(run.parameters["director"]["seed"], int(value["seed"]))
                physics = run.parameters["physics"]
                samples, v_rms = run.series("flow", "v_rms")
            activity = "" if value["point"] == "thick" else str(physics["activity"]["activity"])
            self.assertEqual(value["physics.activity.activity"], activity)
            self.assertEqual(value["physics.flow.viscosity"], "1.0" if value["point"] == "thick" else "")
            self.assertEqual(physics["flow"]["viscosity"], 1.0 if value["point"] == "thick" else 0.5)
            self.assertAlmostEqual(float(value["flow.v_rms"]), v_rms[samples > 0.02].mean(), delta=1e-15)
            self.assertEqual(value["status"], "done")
            means.setdefault(value["point"], []).append(float(value["flow.v_rms"]))
        self.assertEqual(len({mean for pair in means.values() for mean in pair}), 6)  # all are different runs

        points = self.table("out", "table.csv")
        self.assertEqual([(point["point"], point["runs_done"], point["runs"]) for point in points],
                         [("activity_0.05", "2", "2"), ("activity_-0.05", "2", "2"), ("thick", "2", "2")])
        for point in points:
            pair = means[point["point"]]
            self.assertAlmostEqual(float(point["flow.v_rms"]), sum(pair) / 2, delta=1e-15)
            self.assertAlmostEqual(float(point["flow.v_rms error"]), statistics.stdev(pair) / math.sqrt(2), delta=1e-15)
            self.assertEqual(point["flow.v_rms error_over"], "seeds")

        text = self.read("out", "table.md")
        self.assertIn(text, out)
        self.assertRegex(text, r"\| thick +\| +\| +1\.0 \| +2 \| +0\.\d+ ± 0\.\d+ \(seeds\) \|")
        self.assertIn("flow.v_rms (m/s)", text)
        self.assertIn("flow.v_rms: mean after 0.02 s to the end.", text)

        before = {name: pathlib.Path(self.path("out", name)).read_bytes()
                  for name in ("runs.csv", "values.csv", "table.csv", "table.md")}
        _, err = self.sweep("--parallel", "1")
        self.assertEqual(err, "")
        for name, content in before.items():
            self.assertEqual(pathlib.Path(self.path("out", name)).read_bytes(), content, name)

    def test_runs_at_a_time_change_nothing(self):
        self.sweep("--quiet", "--parallel", "3")
        self.mesogen("sweep", "sweep.toml", "--output", "alone", "--quiet", "--parallel", "1", "--threads", "2")
        self.assertEqual(self.read("out", "values.csv"), self.read("alone", "values.csv"))

    def test_one_seed_has_its_error_over_blocks(self):
        late = '[[quantity]]\nseries = "flow.v_rms"\nname = "late"\nfrom = 0.05\nuntil = 0.09\n'
        self.write(SWEEP.replace("seeds = [1, 2]\n", "") + "blocks = 2\n" + late, "sweep.toml")
        self.sweep("--quiet")
        for value, point in zip(self.table("out", "values.csv"), self.table("out", "table.csv"), strict=True):
            self.assertEqual((value["run"], value["seed"], value["flow.v_rms blocks"]), (point["point"], "", "2"))
            with mesogen.open(self.path("out", "runs", value["run"])) as run:
                time, v_rms = run.series("flow", "v_rms")
            inside = v_rms[time > 0.02]
            half = (len(inside) + 1) // 2
            error = abs(inside[:half].mean() - inside[half:].mean()) / 2  # of two blocks
            self.assertAlmostEqual(float(point["flow.v_rms error"]), error, delta=1e-15)
            self.assertEqual(point["flow.v_rms error_over"], "blocks")
            self.assertAlmostEqual(float(point["late"]), v_rms[(time > 0.05) & (time <= 0.09)].mean(), delta=1e-15)
            self.assertEqual(point["late error_over"], "")
        text = self.read("out", "table.md")
        self.assertIn("late: mean of flow.v_rms after 0.05 s up to 0.09 s.", text)
        self.assertRegex(text, r"- activity_0\.05, activity_-0\.05, thick: late has \d samples, too few for 4 blocks\n")

    def test_list_runs_nothing(self):
        out, _ = self.sweep("--list")
        lines = out.splitlines()
        self.assertEqual([line.split()[1] for line in lines], [label + ":" for label in LABELS])
        self.assertRegex(lines[1], r"^missing  activity_-0\.05-seed_1: \S*mesogen run case\.toml --set "
                                   r"physics\.activity\.activity=-0\.05 --set director\.seed=1 --output "
                                   r"out/runs/activity_-0\.05-seed_1 --threads 1$")
        self.assertFalse(os.path.exists(self.path("out")))

    def test_a_killed_sweep_goes_on_from_checkpoints(self):
        self.write(LONGER, "case.toml")
        self.write(ONE_LONG, "sweep.toml")
        self.mesogen("sweep", "sweep.toml", "--output", "unbroken", "--quiet")
        for stop, code in ((signal.SIGKILL, -9), (signal.SIGINT, 130)):
            process = self.start_sweep()
            self.wait_for(process, "runs", "activity_0.05-seed_1", "checkpoint_b.h5")
            self.wait_for(process, "runs", "activity_-0.05-seed_1", "checkpoint_b.h5")
            process.send_signal(stop)
            _, err = process.communicate(timeout=60)
            self.assertEqual(process.returncode, code)
            if stop == signal.SIGINT:
                self.assertEqual(err, "interrupted: what was done is kept; the same command goes on\n")
            self.assertEqual(self.sweep("--list")[0].count("begun    "), 2)
            _, err = self.sweep()
            self.assertEqual(len(re.findall(r"seed_1: done, .*, gone on with from its checkpoint\n", err)), 2, err)
            self.assertEqual(self.read("out", "values.csv"), self.read("unbroken", "values.csv"))
            os.rename(self.path("out"), self.path(f"out{code}"))

    def test_a_run_that_was_killed_is_tried_again(self):
        self.write(LONGER, "case.toml")
        self.write(ONE_LONG.replace("parallel = 2", "parallel = 1"), "sweep.toml")
        process = self.start_sweep("--quiet")
        self.wait_for(process, "runs", "activity_0.05-seed_1", "checkpoint_b.h5")
        with open(f"/proc/{process.pid}/task/{process.pid}/children", encoding="ascii") as children:
            os.kill(int(children.read().split()[0]), signal.SIGKILL)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 0)  # the others are done all the same
        self.assertIn("\n- activity_0.05-seed_1: KILLED: was ended by SIGKILL\n", self.read("out", "table.md"))
        self.assertEqual([row["status"] for row in self.table("out", "runs.csv")], ["killed", "done"])
        _, err = self.sweep()
        self.assertRegex(err, r"^2 of 2  activity_0\.05-seed_1: done, \S+ s, gone on with from its checkpoint\n$")

    def test_a_run_whose_checkpoints_are_damaged_begins_again(self):
        self.write(LONGER, "case.toml")
        self.write(ONE_LONG, "sweep.toml")
        self.sweep("--quiet")
        before = self.read("out", "values.csv")
        os.remove(self.path("out", "runs.csv"))
        for letter in "ab":
            self.write("nothing", "out", "runs", "activity_0.05-seed_1", f"checkpoint_{letter}.h5")
        third = self.path("out", "runs", "activity_0.05-seed_1", "checkpoint_before_end.h5")
        if os.path.exists(third):  # where the end is no time asked for
            os.remove(third)
        _, err = self.sweep()
        self.assertRegex(err, r"activity_0\.05-seed_1: done, [\d.]+ s\n")
        self.assertRegex(err, r"activity_-0\.05-seed_1: done, \S+ s, gone on with from its checkpoint\n")
        self.assertEqual(self.read("out", "values.csv"), before)

    def test_what_changed_runs_again(self):
        self.sweep("--quiet")
        self.write(SWEEP.replace("= 1.0", "= 1.1"), "sweep.toml")
        _, err = self.sweep()
        for seed in (1, 2):
            self.assertIn(f"thick-seed_{seed} runs again: the sweep, its case or a default of mesogen has changed\n", err)
        self.assertEqual(len(self.table("out", "runs.csv")), 8)
        self.assertNotIn("activity", err)

        self.write(SWEEP, "sweep.toml")  # as it was: what lies there is of the other form
        self.assertIn("missing  thick-seed_1", self.sweep("--list")[0])
        self.sweep("--quiet")
        os.remove(self.path("out", "runs", "thick-seed_1", "results.h5"))
        self.write("# a remark changes nothing\n" + CASE, "case.toml")
        os.remove(self.path("out", "runs", "thick-seed_1", "checkpoint_a.h5"))
        os.remove(self.path("out", "runs", "thick-seed_1", "checkpoint_b.h5"))
        self.assertIn("thick-seed_1 runs again: its results are gone\n", self.sweep()[1])
        self.assertEqual(len(self.table("out", "runs.csv")), 11)

        text = re.sub(", defaults [0-9a-f]+", ", defaults 0123456789ab", self.read("out", "runs.csv"))
        self.write(text, "out", "runs.csv")
        self.assertIn("nothing has run yet", self.sweep("--collect-only", code=2)[1])

    def test_a_run_that_fails_is_told_with_its_reason(self):
        self.write(SWEEP + RUNS_AWAY, "sweep.toml")
        out, err = self.sweep()
        self.assertRegex(err, r"runs_away-seed_1: FAILED: the run (broke down|ran away)")
        self.assertRegex(out, r"\| runs_away +\| .*\| 0 of 2 \| +\| +\|")
        self.assertRegex(out, r"\n- (runs_away-seed_1, )?runs_away-seed_2: FAILED: the run (broke down|ran away).* at t = ")
        self.assertEqual(self.table("out", "table.csv")[3]["flow.v_rms"], "")
        self.assertEqual(self.table("out", "values.csv")[3]["status"], "failed")
        self.assertEqual(self.sweep()[1], "")  # it is not repeated
        self.assertEqual(self.sweep("--retry")[1].count("FAILED"), 2)

    def test_a_run_that_takes_too_long_goes_on_with_more_time(self):
        self.write(LONGER.replace("end = 1.5", "end = 20.0"), "case.toml")
        self.write(ONE_LONG.replace("parallel", "timeout = 0.6\nparallel"), "sweep.toml")
        _, err = self.sweep()
        self.assertEqual(err.count("TIMEOUT: took longer than 0.6 s"), 2)
        self.assertIn("- activity_0.05-seed_1, activity_-0.05-seed_1: TIMEOUT: took longer than 0.6 s\n", self.read("out", "table.md"))
        self.assertEqual(self.sweep()[1], "")
        self.write(ONE_LONG.replace("parallel", "timeout = 0.8\nparallel"), "sweep.toml")
        self.assertEqual(self.sweep()[1].count("took longer than 0.8 s, gone on with from its checkpoint"), 2)

    def test_collect_only(self):
        _, err = self.sweep("--collect-only", code=2)
        self.assertEqual(err, "error: out: nothing has run yet; leave out --collect-only\n")
        self.write(SWEEP.replace("[1, 2]", "[1]"), "sweep.toml")
        self.sweep("--quiet")
        self.write(SWEEP, "sweep.toml")
        out, err = self.sweep("--collect-only")
        self.assertEqual((err, len(self.table("out", "runs.csv"))), ("", 3))
        self.assertRegex(out, r"\| thick .* 1 of 2 \| .*\(blocks\)")
        self.assertIn("\n- activity_0.05-seed_2, activity_-0.05-seed_2, thick-seed_2: missing: has not run yet\n", out)

    def test_two_at_once_are_refused(self):
        os.mkdir(self.path("out"))
        with open(self.path("out", ".lock"), "w", encoding="ascii") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            _, err = self.sweep(code=2)
        self.assertEqual(err, "error: another sweep is writing into out; choose another folder with --output, or wait\n")

    def test_the_package(self):
        sweep = mesogen.sweep.read_sweep(self.path("sweep.toml"), extra={"time.end": 0.05}, seeds=[4])
        self.assertEqual([run.label for run in sweep.runs],
                         ["activity_0.05-seed_4", "activity_-0.05-seed_4", "thick-seed_4"])
        self.assertEqual(sweep.runs[2].overrides, {"time.end": 0.05, "physics.flow.viscosity": 1.0, "director.seed": 4})
        folder = self.path("quick")
        self.assertEqual(mesogen.sweep.finished(sweep, folder), [])
        seen = []

        class Seen(mesogen.runs.progress.Progress):
            def end(self, text, name=""):
                seen.append(name)

        mesogen.sweep.run_sweep(sweep, folder, MESOGEN, parallel=3, progress=lambda *counts: Seen(*counts, quiet=True))
        self.assertEqual(sorted(seen), sorted(run.label for run in sweep.runs))
        done = mesogen.sweep.finished(sweep, folder)
        self.assertEqual([(one.label, one.point.values, one.seed) for one in done],
                         [(run.label, run.point.values, 4) for run in sweep.runs])
        with done[2].open() as run:
            self.assertAlmostEqual(run.times[-1], 0.05, delta=1e-12)
        text, _ = mesogen.sweep.write_tables(sweep, folder)
        self.assertIn("| thick ", text)


if __name__ == "__main__":
    unittest.main()
