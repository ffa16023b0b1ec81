"""sweep --slurm, with an sbatch and a squeue of this test: what is submitted, and what a task does."""

import os
import subprocess
import unittest

from support import MESOGEN
from sweep_case import RUNS_AWAY, SWEEP, SweepTest

SBATCH = """\
#!/bin/sh
echo "$@" >> {folder}/submitted
cp "$2" {folder}/script
echo "41;cluster"
"""
REFUSES = '#!/bin/sh\necho "sbatch: error: invalid partition specified: none" >&2\nexit 1\n'


class Slurm(SweepTest):
    def setUp(self):
        super().setUp()
        os.mkdir(self.path("bin"))
        self.program("sbatch", SBATCH.format(folder=self.folder))
        self.program("squeue", "#!/bin/sh\ncat queue 2>/dev/null\n")

    def program(self, name, text):
        self.write(text, "bin", name)
        os.chmod(self.path("bin", name), 0o755)

    def sweep(self, *arguments, **more):
        return super().sweep(*arguments, PATH=self.path("bin") + ":/usr/bin:/bin", **more)

    def run_task(self, number, code=0):
        """Does what Slurm does with the script that was submitted."""
        environment = self.environment(SLURM_ARRAY_TASK_ID=str(number))
        done = subprocess.run(["sh", self.path("script")], cwd="/", env=environment, capture_output=True, text=True,
                              timeout=300, check=False)
        self.assertEqual((done.returncode, done.stdout), (code, ""), done.stderr)
        return done.stderr

    def test_what_is_submitted(self):
        out, err = self.sweep("--slurm", "--threads", "2", "--parallel", "3", "--slurm-options",
                              "--time=01:00:00 -p 'long one' --exclusive")
        self.assertEqual(err, "")
        self.assertEqual(out, "submitted job 41: 6 runs; --collect-only writes the tables of those that are done\n")
        here = os.path.realpath(self.folder)
        self.assertEqual(self.read("submitted"), "--parsable out/slurm/job.sh\n")
        self.assertEqual(self.read("script").splitlines(), [
            "#!/bin/sh",
            "#SBATCH --job-name=sweep",
            "#SBATCH --array=1-6%3",
            "#SBATCH --ntasks=1",
            "#SBATCH --cpus-per-task=2",
            f"#SBATCH --output={here}/out/slurm/%A_%a.log",
            "#SBATCH --signal=B:TERM@60",
            "#SBATCH --time=01:00:00",
            "#SBATCH -p 'long one'",
            "#SBATCH --exclusive",
            "# Told that its time is over, a task leaves a checkpoint; exec: so that it is told.",
            f"exec {MESOGEN} sweep {here}/sweep.toml --output {here}/out "
            '--threads 2 --quiet --task "$SLURM_ARRAY_TASK_ID"',
        ])
        self.assertEqual([(task["task"], task["label"]) for task in self.table("out", "slurm", "tasks.csv")][2:4],
                         [("3", "thick-seed_1"), ("4", "activity_0.05-seed_2")])
        self.assertFalse(os.path.exists(self.path("out", "runs")))

    def test_tasks_give_what_a_sweep_gives(self):
        self.mesogen("sweep", "sweep.toml", "--output", "here", "--quiet")
        self.sweep("--slurm")
        for task in (6, 2, 3):
            self.assertEqual(self.run_task(task), "")
        self.assertEqual(self.sweep("--list")[0].count("done     "), 3)
        out, _ = self.sweep("--collect-only")
        self.assertRegex(out, r"\| activity_-0\.05 .* 1 of 2 \|")
        out, _ = self.sweep("--slurm")  # only what is missing
        self.assertIn("submitted job 41: 3 runs;", out)
        self.assertEqual([task["label"] for task in self.table("out", "slurm", "tasks.csv")],
                         ["activity_0.05-seed_1", "activity_0.05-seed_2", "activity_-0.05-seed_2"])
        for task in (1, 2, 3, 3):  # one of them twice, as after a node's failure
            self.run_task(task)
        out, _ = self.sweep("--slurm")
        self.assertEqual(out, "nothing to submit: no run is missing; --collect-only writes the tables, --retry submits "
                              "what failed\n")
        self.sweep("--collect-only")
        self.assertEqual(len(self.table("out", "runs.csv")), 6)
        for name in ("values.csv", "table.csv"):
            self.assertEqual(self.read("out", name), self.read("here", name))

    def test_a_dry_run(self):
        out, _ = self.sweep("--slurm", "--dry-run")
        self.assertEqual(out, "wrote out/slurm/tasks.csv and out/slurm/job.sh: 6 runs; nothing was submitted\n")
        self.assertFalse(os.path.exists(self.path("submitted")))
        self.assertIn("#SBATCH --array=1-6\n", self.read("out", "slurm", "job.sh"))

    def test_a_job_in_the_queue(self):
        self.sweep("--slurm")
        self.write("41_[1-6] all sweep root PD\n", "queue")
        _, err = self.sweep("--slurm", code=2)
        self.assertEqual(err, "error: job 41 of this sweep is in the queue; wait for it, or end it with: scancel 41\n")
        os.remove(self.path("queue"))
        self.sweep("--slurm")

    def test_no_slurm(self):
        os.remove(self.path("bin", "sbatch"))
        _, err = super().sweep("--slurm", PATH=self.path("bin"), code=2)
        self.assertEqual(err, "error: sbatch is not found: Slurm is not installed here; --dry-run writes "
                              "out/slurm/job.sh alone, and without --slurm the runs are done on this machine\n")

    def test_what_sbatch_refuses(self):
        self.program("sbatch", REFUSES)
        _, err = self.sweep("--slurm", "--slurm-options=-p none", code=2)
        self.assertEqual(err, "error: sbatch does not take out/slurm/job.sh: invalid partition specified: none\n")
        _, err = self.sweep("--slurm", "--slurm-options=long", code=2)
        self.assertEqual(err, 'error: --slurm-options: "long" is no option of sbatch; write them as in "--time=12:00:00 '
                              '--partition=long"\n')

    def test_a_task_that_is_none(self):
        _, err = self.sweep("--task", "1", code=2)
        self.assertEqual(err, "error: --task: out/slurm/tasks.csv is not there; --slurm writes it\n")
        self.sweep("--slurm")
        _, err = self.sweep("--task", "7", code=2)
        self.assertEqual(err, "error: --task: out/slurm/tasks.csv has no task 7; there are 1 to 6\n")
        self.write(SWEEP.replace("= 1.0", "= 1.1"), "sweep.toml")
        self.assertIn("error: --task: thick-seed_1 is no more the run that was submitted: ", self.run_task(3, code=2))

    def test_a_task_whose_run_fails(self):
        self.write(SWEEP + RUNS_AWAY, "sweep.toml")
        self.sweep("--slurm")
        self.assertRegex(self.run_task(4, code=1), r"^error: runs_away-seed_1: the run (broke down|ran away)")
        self.assertIn("FAILED", self.sweep("--collect-only")[0])


if __name__ == "__main__":
    unittest.main()
