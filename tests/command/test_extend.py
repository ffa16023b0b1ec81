"""resume --set: a run that is finished goes on, as if it had never ended."""

import hashlib
import os
import signal
import subprocess
import time
import unittest

import h5py
import numpy
from support import CASE, MESOGEN, CommandTest

# Observers that add up over steps, and one that goes by steps; frames at other times than samples.
OBSERVERS = """[observers.flow]
type = "flow_statistics"
interval = 0.05
[observers.paths]
type = "pathlines"
count = 5
every = 4
[observers.exponent]
type = "lyapunov"
interval = 0.03
"""
FLOW = '[observers.flow]\ntype = "flow_statistics"\ninterval = 0.05\n'
OBSERVED = CASE.replace(FLOW, OBSERVERS).replace("[output]\ninterval = 0.05", "[output]\ninterval = 0.04")
INCOMPRESSIBLE = OBSERVED.replace('type = "wcsph"', 'type = "incompressible"')


def ending(text, end):
    return text.replace("end = 0.1\n", f"end = {end}\n")


def contents(file):
    """{name: values} of all that results.h5 has of particles and observers."""
    found = {}

    def visit(name, item):
        if isinstance(item, h5py.Dataset):
            found[name] = numpy.asarray(item)

    with h5py.File(file, "r") as results:
        for group in ("particles", "observables"):
            results[group].visititems(lambda name, item, group=group: visit(f"{group}/{name}", item))
    return found


def fingerprint(folder):
    """Of each file in a folder: its bytes and when it was written."""
    files = {}
    for place, _, names in os.walk(folder):
        for name in names:
            path = os.path.join(place, name)
            with open(path, "rb") as file:
                files[path] = (hashlib.sha256(file.read()).hexdigest(), os.stat(path).st_mtime_ns)
    return files


class ExtendedRuns(CommandTest):
    def run_to(self, end, folder, text=OBSERVED):
        self.mesogen("run", self.write_case(ending(text, end)), "--output", folder, "--quiet")

    def expect_same_results(self, folder, other):
        one, two = (contents(self.path(name, "results.h5")) for name in (folder, other))
        self.assertEqual(set(one), set(two))
        for name, values in one.items():
            self.assertTrue(numpy.array_equal(values, two[name], equal_nan=True),
                            f"{name}: {values.shape} {two[name].shape}")

    def attributes(self, folder, group):
        with h5py.File(self.path(folder, "results.h5"), "r") as file:
            return dict(file[group].attrs)

    def test_results_are_those_of_an_unbroken_run(self):
        # Ends between all times asked for, at one of the frames' alone, and with steps of one size.
        fixed = OBSERVED.replace("[time]", "[time]\nstep = 0.005")
        for flow, text in (("wcsph", OBSERVED), ("incompressible", INCOMPRESSIBLE), ("fixed", fixed)):
            self.run_to(0.2, flow, text)
            for end in (0.11, 0.12):
                self.run_to(end, f"{flow}-{end}", text)
                self.mesogen("resume", f"{flow}-{end}", "--set", "time.end=0.2", "--quiet")
                self.expect_same_results(f"{flow}-{end}", flow)

    def test_so_it_is_with_values_in_time_that_get_no_larger(self):
        lit = OBSERVED.replace("activity = 0.05", 'activity = "0.05 + 0.04 * (t < 0.05) * (x < 0.8)"')
        self.run_to(0.2, "whole", lit)
        self.run_to(0.11, "out", lit)
        self.mesogen("resume", "out", "--set", "time.end=0.2", "--quiet")
        self.expect_same_results("out", "whole")
        self.run_to(0.11, "later", OBSERVED.replace("activity = 0.05", 'activity = "0.05 + 0.04 * (t > 0.15)"'))
        _, err = self.mesogen("resume", "later", "--set", "time.end=0.2", code=2)
        self.assertIn("time.end: cannot be 0.2 s: physics.activity.activity gets larger on the way there than up to t = "
                      "0.11 s, by which the run chose its steps and its speed of sound; `mesogen branch later NEW --set "
                      "time.end=0.2` goes on with others", err)

    def test_twice_and_with_a_kill_between(self):
        often = OBSERVED.replace("[output]", "[output]\ncheckpoint_interval = 0.02")
        self.run_to(0.11, "out", often)
        self.mesogen("resume", "out", "--set", "time.end=0.17", "--quiet")
        process = subprocess.Popen([MESOGEN, "resume", "out", "--set", "time.end=1.0", "--quiet"], cwd=self.folder,
                                   env=self.environment())
        time.sleep(0.5)
        process.send_signal(signal.SIGKILL)
        process.wait()
        self.mesogen("resume", "out", "--quiet")
        self.run_to(1.0, "whole", often)
        self.expect_same_results("out", "whole")

    def test_the_stored_case_and_the_cost_tell_of_all_of_it(self):
        self.run_to(0.1, "out")
        before = self.attributes("out", "parameters/cost")
        self.mesogen("resume", "out", "--set", "time.end=0.2", "--set", "title=longer", "--quiet")
        with open(self.path("out", "case.toml"), encoding="utf-8") as file:
            text = file.read()
        with h5py.File(self.path("out", "results.h5"), "r") as file:
            self.assertEqual(file["parameters/case"][()].decode(), text)
            steps = int(file["observables/flow/v_rms/step"][-1])
        self.assertIn("end = 0.2\n", text)
        self.assertIn('title = "longer"', text)
        after = self.attributes("out", "parameters/cost")
        self.assertEqual((before["sessions"], after["sessions"]), (1, 2))
        self.assertEqual(after["steps"], steps)
        self.assertGreater(after["wall_seconds"], before["wall_seconds"] / 2)

    def test_a_finished_run_is_left_as_it_is(self):
        self.run_to(0.1, "out")
        before = fingerprint(self.path("out"))
        for change in ([], ["--set", "time.end=0.1"]):
            _, err = self.mesogen("resume", "out", *change)
            self.assertIn("this run is finished, at t = 0.1 s, and left as it is. `mesogen resume out --set "
                          "time.end=0.2` extends it; `mesogen branch out NEW` starts a new run", err)
            self.assertEqual(fingerprint(self.path("out")), before)

    def test_what_would_change_the_past_is_refused(self):
        self.run_to(0.1, "out")
        before = fingerprint(self.path("out"))
        for change, expected in (
                ("physics.flow.viscosity=1.0",
                 "physics.flow.viscosity: cannot change while a run goes on: its past was computed with the old "
                 "value; `mesogen branch out NEW --set physics.flow.viscosity=1.0` starts a new run with it from a "
                 "checkpoint. What can change here: time.end, output.checkpoint_interval, output.checkpoint_times, "
                 "run.device, title"),
                ("output.interval=0.01", "output.interval: cannot change while a run goes on"),
                ("time={end=1.0}", "time: cannot change while a run goes on"),
                ("time.end=0.05", "time.end: must be later than t = 0.1 s, since the run has come that far, but is "
                                   "0.05 s"),
                ("output.checkpoint_times=[0.05, 0.2]",
                 "output.checkpoint_times: must stay as it was up to t = 0.1 s, where the run is now: [], and may name "
                 "other times only after that")):
            _, err = self.mesogen("resume", "out", "--set", change, code=2)
            self.assertIn(expected, err)
            self.assertEqual(fingerprint(self.path("out")), before)

    def test_an_end_where_the_run_has_come_to_is_refused(self):
        self.run_to(0.1, "out")
        case = self.path("out", "case.toml")
        with open(case, encoding="utf-8") as file:
            text = file.read()
        with open(case, "w", encoding="utf-8") as file:
            file.write(text.replace("end = 0.1\n", "end = 0.2\n"))  # as if it was broken off at 0.1
        before = fingerprint(self.path("out"))
        for end in ("0.1", "0.1000000001"):
            _, err = self.mesogen("resume", "out", "--set", f"time.end={end}", code=2)
            self.assertIn("time.end: must be later than t = 0.1 s, since the run has come that far, but is 0.1 s", err)
            self.assertEqual(fingerprint(self.path("out")), before)

    def test_checkpoints_can_be_asked_for_later(self):
        self.run_to(0.1, "out")
        self.mesogen("resume", "out", "--set", "time.end=0.2", "--set", "output.checkpoint_times=[0.15]", "--quiet")
        self.assertEqual(len(os.listdir(self.path("out", "checkpoints"))), 1)


if __name__ == "__main__":
    unittest.main()
