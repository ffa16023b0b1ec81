"""Ctrl-C, SIGKILL and resume."""

import os
import shutil
import signal
import time
import unittest

import h5py
import numpy
from support import CASE, CommandTest

LONGER = CASE.replace("end = 0.1", "end = 1.0").replace("[output]", "[output]\ncheckpoint_interval = 0.05")


class Interruption(CommandTest):
    def start_run(self, case):
        """Starts a run and waits until it has written its first checkpoint."""
        process = self.start("run", case, "--output", "out")
        self.wait_for(process, "out", "checkpoint_a.h5")
        return process

    def final(self, folder):
        with h5py.File(self.path(folder, "results.h5"), "r") as file:
            fluid = file["particles/fluid"]
            return {field: numpy.asarray(fluid[field]["value"][-1]) for field in ("position", "velocity", "order_tensor")}

    def steps_of_frames(self, folder):
        with h5py.File(self.path(folder, "results.h5"), "r") as file:
            return list(file["particles/fluid/position/step"])

    def step_of_checkpoint(self, folder):
        """Of the newest."""
        steps = []
        for name in ("checkpoint_a.h5", "checkpoint_b.h5"):
            if os.path.exists(self.path(folder, name)):
                with h5py.File(self.path(folder, name), "r") as file:
                    steps.append(int(file.attrs["step"]))
        return max(steps)

    def expect_same_as_unbroken(self, case):
        self.mesogen("run", case, "--output", "unbroken", "--quiet")
        expected, found = self.final("unbroken"), self.final("out")
        for field in expected:
            self.assertTrue(numpy.array_equal(expected[field], found[field]), field)

    def test_interrupt_writes_a_checkpoint_and_resume_goes_on(self):
        case = self.write_case(LONGER)
        for stop in (signal.SIGINT, signal.SIGTERM):
            process = self.start_run(case)
            process.send_signal(stop)
            _, err = process.communicate(timeout=60)
            self.assertEqual(process.returncode, 130, err)
            self.assertIn("mesogen resume out", err)
            _, err = self.mesogen("resume", "out")
            self.assertIn("resuming from", err)
            self.expect_same_as_unbroken(case)
            shutil.rmtree(self.path("out"))
            shutil.rmtree(self.path("unbroken"))

    def test_kill_and_resume_give_the_same_bits(self):
        case = self.write_case(LONGER)
        process = self.start_run(case)
        time.sleep(0.2)
        process.kill()
        process.communicate()
        saved, there = self.step_of_checkpoint("out"), self.steps_of_frames("out")
        self.mesogen("resume", "out", "--quiet")
        self.expect_same_as_unbroken(case)
        frames = self.steps_of_frames("unbroken")
        self.assertEqual(self.steps_of_frames("out"), frames)
        before = [step for step in frames if step <= saved]
        self.assertEqual(there[:len(before)], before, "no checkpoint is newer than a frame that is not on disk")

    def test_other_instruction_sets_are_told(self):
        info, _ = self.mesogen("plugin", "info", "wcsph")
        if "(baseline)" in info:
            self.skipTest("this processor or build has the baseline alone")
        built_for = info.split("wcsph.so (")[1].split(")")[0]
        process = self.start_run(self.write_case(LONGER))
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
        _, err = self.mesogen("resume", "out", MESOGEN_SIMD="baseline")
        self.assertRegex(err, r"warning: the run goes on, but not to the same bits: checkpoint_[ab]\.h5 was written by code "
                              rf"for other instruction sets \(derivatives {built_for}, wcsph {built_for}, .*\) than this "
                              rf"processor or MESOGEN_SIMD chooses \(derivatives {built_for}, wcsph baseline, .*\)")

    def test_resume_on_the_same_processor_warns_of_nothing(self):
        process = self.start_run(self.write_case(LONGER))
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
        _, err = self.mesogen("resume", "out")
        self.assertNotIn("warning", err)

    def test_folder_in_use_is_refused(self):
        process = self.start_run(self.write_case(LONGER))
        _, err = self.mesogen("resume", "out", code=2)
        self.assertIn("another run is writing into out", err)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)

    def test_resume_of_what_is_no_run(self):
        _, err = self.mesogen("resume", "nothing", code=2)
        self.assertIn("nothing", err)
        os.mkdir(self.path("empty"))
        _, err = self.mesogen("resume", "empty", code=2)
        self.assertIn("empty", err)


if __name__ == "__main__":
    unittest.main()
