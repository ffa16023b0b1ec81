"""Runs on several processes that are killed, resumed, or go wrong: no end without a message."""

import os
import re
import shutil
import signal
import subprocess
import time
import unittest

from ranks import HOW, JITTERED, OBSERVERS, RanksTest
from support import CASE, MESOGEN

LONGER = JITTERED.replace("end = 0.1", "end = 40.0").replace("interval = 0.05", "interval = 20.0").replace(
    "[output]", "[output]\ncheckpoint_interval = 0.05")


class Interruption(RanksTest):
    def child(self, process):
        """One of the ranks."""
        found = subprocess.run(["pgrep", "-P", str(process.pid)], text=True, capture_output=True, check=False)
        self.assertTrue(found.stdout.split())
        return int(found.stdout.split()[-1])

    def test_a_rank_that_dies_ends_all_and_a_resumed_run_has_the_same_bits(self):
        case = self.write_case(LONGER)
        self.ranks(2, "run", case, "--output", "unbroken", "--quiet")
        process = self.start_ranks(2, "run", case, "--output", "out", "--quiet")
        os.kill(self.child(process), signal.SIGKILL)
        begin = time.time()
        _, err = process.communicate(timeout=60)
        self.assertLess(time.time() - begin, 30.0)
        self.assertNotEqual(process.returncode, 0)
        self.assertIn("signal 9", err)
        self.ranks(2, "resume", "out", "--quiet")
        self.expect_same("unbroken", "out")

    def test_ctrl_c_writes_a_checkpoint(self):
        process = self.start_ranks(2, "run", self.write_case(LONGER), "--output", "out", "--quiet")
        os.kill(self.child(process), signal.SIGTERM)  # one of them is enough
        _, err = process.communicate(timeout=60)
        self.assertIn("mesogen resume out", err)
        self.assertEqual(err.count("mesogen resume out"), 1)

    # Rounding grows with the flow, so not for long.
    def test_other_numbers_of_ranks_go_on_to_rounding(self):
        case = self.write_case(JITTERED + OBSERVERS)
        longer = "time.end=0.2"
        self.ranks(2, "run", case, "--output", "two", "--quiet")
        for ranks in (1, 3):
            shutil.copytree(self.path("two"), self.path(f"by_{ranks}"))
        self.ranks(2, "resume", "two", "--set", longer, "--quiet")
        self.mesogen("resume", "by_1", "--set", longer, "--quiet")
        self.ranks(3, "resume", "by_3", "--set", longer, "--quiet")
        for ranks in (1, 3):
            self.expect_same("two", f"by_{ranks}", 1e-12)

    def test_a_branch_is_that_of_one_process(self):
        self.mesogen("run", self.write_case(JITTERED), "--output", "one", "--quiet")
        change = ("--set", "physics.activity.activity=0.07", "--set", "time.end=0.2")
        self.mesogen("branch", "one", "alone", *change, "--quiet")
        self.ranks(3, "branch", "one", "several", *change, "--quiet")
        self.expect_same("alone", "several", 1e-12)

    def test_what_one_process_began_several_go_on_with(self):
        case = self.write_case(JITTERED)
        self.mesogen("run", case, "--output", "one", "--quiet")
        shutil.copytree(self.path("one"), self.path("two"))
        self.mesogen("resume", "one", "--set", "time.end=0.2", "--quiet")
        self.ranks(2, "resume", "two", "--set", "time.end=0.2", "--quiet")
        self.expect_same("one", "two", 1e-12)


class Messages(RanksTest):
    def errors(self, err):
        """Those lines that are Mesogen's."""
        return [line for line in err.splitlines() if line.startswith("error: ")]

    def test_a_mistake_in_the_case_is_told_once(self):
        err = self.ranks(2, "run", self.write_case(CASE.replace("viscosity = 0.5", "viscosity = -0.5")), code=2)
        self.assertEqual(len(self.errors(err)), 1, err)
        self.assertIn("physics.flow.viscosity", self.errors(err)[0])

    def test_the_rank_of_the_worst_particle_tells_how_a_run_broke_down(self):
        text = JITTERED.replace("[time]", '[time]\nstepping = "explicit"\nstep = 0.1').replace("end = 0.1", "end = 9.0")
        _, alone = self.mesogen("run", self.write_case(text), "--output", "one", "--quiet", code=1)
        err = self.ranks(3, "run", self.write_case(text), "--output", "out", "--quiet", code=1)
        told = self.errors(err)
        self.assertEqual(len(told), 1, err)
        self.assertIn("the run ", told[0])
        self.assertEqual(told[0].split("rank ")[-1].split(": ", 1)[-1].split(" (")[0].removeprefix("error: "),
                         alone.splitlines()[0].split(" (")[0].removeprefix("error: "))

    def test_samples_before_a_breakdown_are_kept(self):
        text = JITTERED.replace("[time]", '[time]\nstepping = "explicit"\nstep = 0.1').replace("end = 0.1", "end = 9.0")
        case = self.write_case(text.replace('type = "flow_statistics"\ninterval = 0.05',
                                            'type = "flow_statistics"\nevery = 1'))
        self.mesogen("run", case, "--output", "one", "--quiet", code=1)
        self.ranks(3, "run", case, "--output", "out", "--quiet", code=1)
        samples = [len(self.results(folder)["observables/flow/v_rms/value"]) for folder in ("one", "out")]
        self.assertGreater(samples[0], 1)
        self.assertEqual(samples[0], samples[1])

    # Two particles that come close across the border of two ranks: each of them sees the other as a ghost.
    def test_a_close_pair_is_told_as_on_one_process(self):
        text = CASE.replace("spacing = 0.1", 'spacing = 0.1\narrangement = "jittered"\njitter = 0.5\nseed = 44')
        text = text.replace("[time]", '[time]\nstepping = "explicit"\nstep = 1e-6').replace("end = 0.1", "end = 2e-4")
        text = text.replace("interval = 0.05", "interval = 2e-4")
        case = self.write_case(text)
        _, alone = self.mesogen("run", case, "--output", "one", "--quiet", code=1)
        self.assertIn("spacings apart", alone)
        err = self.ranks(7, "run", case, "--output", "out", "--quiet", code=1)
        self.assertEqual(self.errors(err), self.errors(alone))

    def test_only_the_first_rank_writes_a_trace(self):
        self.ranks(3, "run", self.write_case(CASE), "--output", "out", "--trace", "trace.json", "--quiet")
        self.assertIn("framework: values beyond the faces", self.read("trace.json"))

    def test_a_replay_is_for_one_process(self):
        self.mesogen("run", self.write_case(CASE), "--output", "out", "--quiet")
        err = self.ranks(2, "replay", "out", code=2)
        self.assertEqual(self.errors(err), ["error: a replay runs on one process: start it without mpirun or srun"])

    def test_ranks_of_another_mpi(self):
        done = subprocess.run([MESOGEN, "run", self.write_case(CASE)], cwd=self.folder, text=True, capture_output=True,
                              env=self.environment(**HOW, PMI_SIZE="2"), timeout=60, check=False)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("this process was started as one of 2, but MPI sees 1: start it by the mpirun of the MPI",
                      done.stderr)

    def test_ranks_that_start_from_different_cases(self):
        one = self.write_case(CASE)
        other = self.write_case(CASE.replace("viscosity = 0.5", "viscosity = 0.6"), "other.toml")
        run = [MESOGEN, "run", "--output", "out", "--threads", "1", "--quiet"]
        done = subprocess.run(["mpirun", "-n", "1", *run, one, ":", "-n", "1", *run, other], cwd=self.folder, text=True,
                              env=self.environment(**HOW), capture_output=True, timeout=60, check=False)
        self.assertEqual(self.errors(done.stderr),
                         ["error: ranks start from different cases, or from code for different processors: let all of "
                          "them read one folder, on processors of one kind"])

    def test_devices_are_for_one_process(self):
        err = self.ranks(2, "run", self.write_case(CASE), "--output", "out", "--set", 'run.device="cuda"', code=2)
        self.assertIn('several ranks compute on the host alone, "cpu"; on a device take one process', err)

    def test_more_ranks_than_rows(self):
        case = self.write_case(CASE)
        err = self.ranks(8, "run", case, "--output", "out", "--quiet", code=2)
        self.assertIn("8 ranks cannot share a box of 7 rows of cells: take at most 7 ranks", err)

    # Each of 2 ranks has 8 rows of 16 particles; it sees those of 4 rows above and below, as many as a support is high,
    # and half of another row of cells where cells are 16/7 rows high.
    def test_the_profile_tells_what_ranks_send(self):
        text = CASE.replace("[time]", '[time]\nstepping = "explicit"').replace("end = 0.1", "end = 0.5")
        case = self.write_case(text.replace("interval = 0.05", "interval = 0.5"))  # readers have ghosts too
        err = self.ranks(2, "run", case, "--output", "out", "--profile")
        told = re.search(r"2 ranks; at most, a rank has (\d+) particles \((.+) % more than the mean\), sees (\d+) of "
                         r"others, sends (\d+) bytes a step for ghosts and (\d+) in all, in .+ messages", err)
        self.assertTrue(told, err)
        particles, above, others, ghosts, everything = (float(number) for number in told.groups())
        self.assertEqual(above, round(100.0 * (particles / 128.0 - 1.0), 1))
        self.assertIn(others, (112.0, 128.0))
        # Two coordinates and seven numbers in double precision a step: volume, velocity, order tensor, compression and
        # pressure. Once more before the first step, which is not counted.
        self.assertAlmostEqual(ghosts / (8 * 9 * others), 1.0, delta=0.1)
        self.assertGreater(everything, ghosts)

    def test_the_log_tells_of_ranks(self):
        err = self.ranks(2, "run", self.write_case(CASE), "--output", "out")
        self.assertIn("256 particles, 2 ranks of 1 thread, double precision", err)
        self.assertEqual(err.count("256 particles"), 1)
        self.assertIn("256 particles, 2 ranks of 1 thread", self.read("out", "run.log"))


if __name__ == "__main__":
    unittest.main()
