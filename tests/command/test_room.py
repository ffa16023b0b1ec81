"""check, run and resume where the machine has too little memory or disk, and how well memory is predicted."""

import json
import os
import re
import resource
import subprocess
import sys
import unittest

from support import CASE, MESOGEN, PROJECT, CommandTest

sys.path.insert(0, os.path.join(PROJECT, "python"))
import mesogen  # noqa: E402

# A nematic without flow, large enough for its particles to matter.
STILL = """\
[domain]
size = [4.0, 4.0]
boundary = "periodic_ghosts"
[particles]
spacing = 0.02
[kernel]
type = "quintic"
[director]
type = "perturbed"
amplitude = 0.1
[physics.nematic]
type = "beris_edwards"
rotational_diffusivity = 0.4
flow_alignment = 0.7
elastic_constant = 0.02
bulk = { A = -1.0, C = 0.5 }
[time]
end = 0.05
[run]
precision = "single"
"""


class TooLittleRoom(CommandTest):
    def test_disk_that_is_too_small(self):
        case = self.write_case()
        out, err = self.mesogen("check", case, "--quick", "--set", "output.interval=1e-11", code=2)
        self.assertRegex(err, r"(?m)^error: --set: output\.interval: 1e\+10 frames of 0\.0184 MB and 2 checkpoints of "
                              r"\S+ MB need \S+ GB of disk \(frames are there twice while they are packed at the end\), but "
                              r"\S+ GB are free; an interval of \S+ s or more fits\n$")
        self.assertIn("case.toml cannot be run here\n", out)
        interval = re.search(r"interval of (\S+) s or more fits", err)[1]
        out, _ = self.mesogen("check", case, "--quick", "--set", f"output.interval={interval}")
        self.assertIn("case.toml can be run\n", out)

    def test_samples_that_do_not_fit_the_memory(self):
        case = self.write_case()
        for command in (["check", case, "--quick"], ["run", case, "--output", "out"]):
            _, err = self.mesogen(*command, "--set", "observers.flow.interval=1e-13", code=2)
            self.assertRegex(err, r"(?m)^error: --set: observers\.flow\.interval: 1e\+12 samples are kept in memory until the "
                                  r"run ends and need \S+ GB, but \S+ GB are available; choose at least \S+ s\n$")
        self.assertFalse(os.path.exists(self.path("out")))
        interval = re.search(r"choose at least (\S+) s", err)[1]
        self.mesogen("check", case, "--quick", "--set", f"observers.flow.interval={interval}")

    def test_memory_of_a_large_case_is_told_without_taking_it(self):
        case = self.write_case(STILL.replace("0.02\n[kernel]", "0.002\n[kernel]"))  # 4 million particles
        out, _ = self.mesogen("check", case, "--quick")
        self.assertRegex(out, r"(?m)^  memory +\S+ GB")


@unittest.skipIf(os.environ.get("SANITIZED"), "sanitizers have a memory of their own")
class Memory(CommandTest):
    """The peak of a run is predicted within a fifth: from the case alone, for a small run and for large ones."""

    def expect_predicted(self, text, *settings):
        case = self.write_case(text)
        told = json.loads(self.mesogen("check", case, *settings, "--quick", "--json")[0])["memory"]["peak"]
        self.mesogen("run", case, *settings, "--output", "out", "--overwrite", "--quiet")
        found = mesogen.open(self.path("out")).cost.peak_memory
        self.assertLess(abs(told - found), 0.2 * found, f"{told / 1e6} MB predicted, {found / 1e6} MB resident")

    def test_small_run(self):
        self.expect_predicted(CASE)

    def test_large_run_with_flow(self):
        self.expect_predicted(CASE, "--set", "particles.spacing=0.008", "--set", "time.end=0.001")

    def test_large_run_without_flow(self):
        self.expect_predicted(STILL)


@unittest.skipIf(os.environ.get("SANITIZED"), "sanitizers take an address space beyond all limits")
class TooLittleMemory(CommandTest):
    """What needs more memory than there is is refused before anything is written, with what fits."""

    def limited(self, *arguments, code, megabytes=4096):
        """The command with so much address space, as by ulimit -v."""
        done = subprocess.run([MESOGEN, *arguments], cwd=self.folder, env=self.environment(), text=True, check=False,
                              capture_output=True, timeout=300,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (megabytes << 20, megabytes << 20)))
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout, done.stderr

    def refusal(self, *arguments):
        _, err = self.limited(*arguments, code=2)
        found = re.match(r"error: \S*: particles\.spacing: \S+ particles need (\S+) GB of memory, but (\S+) GB are "
                         r"available; (\S+) particles fit, with a spacing of (\S+) m\n$", err)
        self.assertIsNotNone(found, err)
        return [float(number) for number in found.groups()]

    def test_particles_are_refused_with_how_many_fit(self):
        case = self.write_case()
        # Twice what there is, of which all is known; 400 times that, where the positions alone would not fit.
        for spacing in ("0.00045", "4e-5"):
            for verb in (["check"], ["check", "--quick"], ["check", "--json"], ["run", "--output", "out"]):
                needed, available, fit, fitting = self.refusal(verb[0], case, *verb[1:], "--set", f"particles.spacing={spacing}")
                self.assertGreater(needed, available)
                self.assertLess(available, 4.3)
                self.assertAlmostEqual(fit, (1.6 / fitting) ** 2, delta=2e-5 * fit)
        self.assertFalse(os.path.exists(self.path("out")))
        arguments = ("--set", f"particles.spacing={fitting!r}")
        told = json.loads(self.limited("check", case, "--quick", "--json", *arguments, code=0)[0])["memory"]
        self.assertLess(told["peak"], told["available"])
        self.assertGreater(told["peak"], 0.6 * told["available"], "more would fit")

    def test_what_is_said_to_fit_runs(self):
        case = self.write_case()
        shortly = ("--set", "time.end=1e-5", "--set", "run.precision=\"single\"")
        arguments = ("run", case, "--output", "out", *shortly)
        _, err = self.limited(*arguments, "--set", "particles.spacing=1e-3", code=2, megabytes=1024)
        spacing = re.search(r"with a spacing of (\S+) m", err)[1]
        self.limited(*arguments, "--set", f"particles.spacing={spacing}", code=0, megabytes=1024)

    def test_resume_where_there_is_less(self):
        self.mesogen("run", self.write_case(), "--output", "out", "--set", "particles.spacing=0.003", "--set", "time.end=1e-5")
        _, err = self.limited("resume", "out", code=2, megabytes=256)
        self.assertRegex(err, r"out/case\.toml:\d+:\d+: particles\.spacing: \S+ particles need ")


if __name__ == "__main__":
    unittest.main()
