"""Sweeps whose runs are shared by several processes."""

import csv
import os
import signal
import time
import unittest

from ranks import HOW, MPI
from sweep_case import LONGER, SWEEP, SweepTest
from support import MESOGEN

SHARED = SWEEP.replace("[1, 2]", "[1]").replace("parallel = 2", "parallel = 1\nranks = 2").replace(
    "[0.05, -0.05]", "[0.05]")


@unittest.skipUnless(MPI, "built without MPI (scripts/setup --mpi)")
class SharedRuns(SweepTest):
    def environment(self, **more):
        return super().environment(**HOW, **more)

    def test_runs_on_two_ranks(self):
        self.write(SHARED, "sweep.toml")
        out, _ = self.sweep("--list")
        words = "mpirun --bind-to none -n 2 "
        self.assertIn(f"activity_0.05-seed_1: {words}{MESOGEN} run ", out)
        self.sweep("--quiet")
        log = self.read("out", "runs", "activity_0.05-seed_1", "run.log")
        self.assertIn("256 particles, 2 ranks of 1 thread", log)
        self.mesogen("sweep", self.write(SHARED.replace("ranks = 2\n", ""), "alone.toml"), "--output", "alone",
                     "--quiet")
        shared, alone = self.table("out", "values.csv"), self.table("alone", "values.csv")
        self.assertEqual(len(shared), 2)
        for one, other in zip(shared, alone):
            self.assertAlmostEqual(float(one["flow.v_rms"]) / float(other["flow.v_rms"]), 1.0, delta=1e-9)

    def test_what_mesogen_refuses_is_told_without_the_words_of_mpirun(self):
        self.write(SHARED.replace('"physics.flow.viscosity" = 1.0', '"physics.flow.viscosity" = -1.0'), "sweep.toml")
        _, err = self.sweep("--quiet", code=2)
        self.assertIn("physics.flow.viscosity: must be > 0", err)
        self.assertNotIn("MPI_ABORT", err)
        self.assertNotIn("----", err)

    def test_ctrl_c_leaves_a_checkpoint_of_shared_runs(self):
        self.write(LONGER.replace("end = 1.5", "end = 30.0"), "case.toml")
        self.write(SHARED, "sweep.toml")
        process = self.start("sweep", "sweep.toml", "--output", "out", "--quiet")
        self.wait_for(process, "out", "runs", "activity_0.05-seed_1", "checkpoint_b.h5")
        process.send_signal(signal.SIGINT)
        begin = time.time()
        _, err = process.communicate(timeout=90)
        self.assertLess(time.time() - begin, 30.0)
        self.assertEqual(process.returncode, 130, err)
        log = self.read("out", "runs", "activity_0.05-seed_1", "run.log")
        self.assertIn("interrupted at t = ", log)

    def test_ranks_are_a_number(self):
        self.write(SHARED.replace("ranks = 2", "ranks = 0"), "sweep.toml")
        _, err = self.sweep("--list", code=2)
        self.assertIn("sweep.toml: ranks: must be a whole number, at least 1", err)


class Scripts(SweepTest):
    def test_a_job_script_asks_for_as_many_tasks(self):
        self.write(SHARED.replace("ranks = 2", "ranks = 4\nthreads = 3"), "sweep.toml")
        self.sweep("--slurm", "--dry-run")
        script = self.read("out", "slurm", "job.sh")
        self.assertIn("#SBATCH --ntasks=4\n#SBATCH --cpus-per-task=3\n", script)
        with open(self.path("out", "slurm", "tasks.csv"), encoding="utf-8", newline="") as file:
            self.assertEqual(len(list(csv.DictReader(file))), 2)
        self.assertTrue(os.access(self.path("out", "slurm", "job.sh"), os.R_OK))


if __name__ == "__main__":
    unittest.main()
