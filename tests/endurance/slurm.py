"""slurm.py MESOGEN: a sweep as a job array of Slurm, on a cluster of this one machine, gives what one without it gives.

Then one whose runs are cancelled half-way, twice, and goes on from their checkpoints. Skipped (exit code 77) where Slurm
is not installed: apt-get install slurm-wlm munge.
"""

import os
import subprocess
import sys
import tempfile
import time

import cluster
import h5py

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "command"))
from small_case import CASE as SMALL  # noqa: E402

SKIPPED = 77
MODES = 'type = "modes"\nmodes = [[1, 0, 0.2, 0.3], [0, 1, 0.1, 1.1]]'
CASE = SMALL.replace(MODES, 'type = "perturbed"\namplitude = 0.3\nseed = 1')
LONG = CASE.replace("end = 0.1", "end = 30.0").replace("[output]", "[output]\ncheckpoint_interval = 0.1").replace(
    "interval = 0.05", "interval = 0.5")
SWEEP = """\
title = "By Slurm"
case = "{case}"
seeds = [1, 2]
[grid]
"physics.activity.activity" = [0.05, -0.05]
[[quantity]]
series = "flow.v_rms"
"""


class Sweeps:
    """The command, in a folder, with a cluster."""

    def __init__(self, mesogen, folder, slurm):
        self.mesogen, self.folder, self.slurm = mesogen, folder, slurm

    def run(self, *words, code=0):
        done = subprocess.run([self.mesogen, "sweep", *words], cwd=self.folder, capture_output=True, text=True,
                              check=False, env=self.slurm.environment)
        assert done.returncode == code, f"{words}: {done.stdout}{done.stderr}{self.logs(words)}"
        return done.stdout + done.stderr

    def logs(self, words):
        folder = os.path.join(self.folder, words[2], "slurm") if len(words) > 2 else ""
        if not os.path.isdir(folder):
            return ""
        return "".join(self.read(words[2], "slurm", name) for name in os.listdir(folder) if name.endswith(".log"))

    def read(self, *parts):
        with open(os.path.join(self.folder, *parts), encoding="utf-8") as file:
            return file.read()

    def write(self, name, text):
        with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
            file.write(text)

    def same(self, one, other):
        for name in ("values.csv", "table.csv"):
            assert self.read(one, name) == self.read(other, name), f"{name} of {one} and {other}"


def plain(sweeps):
    sweeps.write("case.toml", CASE)
    sweeps.write("sweep.toml", SWEEP.format(case="case.toml"))
    sweeps.run("sweep.toml", "-o", "here", "--quiet")
    begun = time.time()
    assert "submitted job" in sweeps.run("sweep.toml", "-o", "slurm", "--slurm", "--slurm-options", "--time=10")
    again = sweeps.run("sweep.toml", "-o", "slurm", "--slurm", code=2)
    assert "of this sweep is in the queue; wait for it, or end it with: scancel" in again, again
    sweeps.slurm.wait()
    sweeps.run("sweep.toml", "-o", "slurm", "--collect-only")
    sweeps.same("slurm", "here")
    assert "nothing to submit" in sweeps.run("sweep.toml", "-o", "slurm", "--slurm")
    took = time.time() - begun
    print(f"4 runs by a job array: {took:.1f} s; the tables are those of a sweep without Slurm", flush=True)


def cancelled(sweeps):
    sweeps.write("long.toml", LONG)
    sweeps.write("long_sweep.toml", SWEEP.format(case="long.toml"))
    sweeps.run("long_sweep.toml", "-o", "long_here", "--quiet")
    left = []
    for _ in range(2):
        sweeps.run("long_sweep.toml", "-o", "long", "--slurm")
        deadline = time.time() + 120
        while sweeps.run("long_sweep.toml", "-o", "long", "--list").count("begun  ") < 2:
            assert time.time() < deadline, "no run began"
            time.sleep(0.1)
        sweeps.slurm.ask("scancel", sweeps.read("long", "slurm", "job").strip())
        sweeps.slurm.wait()
        states = sweeps.run("long_sweep.toml", "-o", "long", "--list")
        left.append(states.count("begun  "))
        assert states.count("done  ") < 4, "nothing was cancelled"
    told = sweeps.run("long_sweep.toml", "-o", "long", "--slurm")
    sweeps.slurm.wait()
    sweeps.run("long_sweep.toml", "-o", "long", "--collect-only")
    sweeps.same("long", "long_here")
    resumed = 0
    for name in os.listdir(os.path.join(sweeps.folder, "long", "runs")):
        with h5py.File(os.path.join(sweeps.folder, "long", "runs", name, "results.h5"), "r") as file:
            resumed += int(file["parameters/cost"].attrs["sessions"] > 1)
    assert resumed >= 2, f"only {resumed} runs went on from a checkpoint"
    last = told.split(": ")[1].split(";")[0]
    print(f"cancelled twice, with {left[0]} and {left[1]} runs begun, then {last}; {resumed} of all went on from "
          "checkpoints: the tables are those of an unbroken sweep", flush=True)


def main():
    missing = cluster.missing()
    if missing:
        print(f"skipped: {', '.join(missing)} not installed (apt-get install slurm-wlm munge)")
        return SKIPPED
    with tempfile.TemporaryDirectory(prefix="mesogen-slurm-") as folder:
        daemons = os.path.join(folder, "cluster")
        os.mkdir(daemons)
        os.chmod(folder, 0o755)
        with cluster.Cluster(daemons) as slurm:
            sweeps = Sweeps(sys.argv[1], folder, slurm)
            plain(sweeps)
            cancelled(sweeps)
    return 0


if __name__ == "__main__":
    sys.exit(main())
