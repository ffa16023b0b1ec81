"""check: what is told of a case, for people and for programs."""

import json
import os
import re
import subprocess
import sys
import unittest

from support import CASE, MESOGEN, PROJECT, CommandTest

sys.path.insert(0, os.path.join(PROJECT, "python"))
import mesogen  # noqa: E402

# Passive, between walls; sound limits its steps to some 0.02 s.
SOON_OVER = """\
[domain]
size = [1.0, 1.0]
boundary = { type = "walls", anchoring = "homeotropic" }
[particles]
spacing = 0.125
[kernel]
type = "quintic"
[director]
type = "uniform"
[physics.flow]
type = "wcsph"
density = 1.0
viscosity = 0.3
[physics.nematic]
type = "beris_edwards"
rotational_diffusivity = 1.0
flow_alignment = 0.5
elastic_constant = 0.01
[physics.elastic]
type = "elastic_stress"
[time]
end = 1.0
"""


class Check(CommandTest):
    def check(self, *arguments):
        return json.loads(self.mesogen("check", self.write_case(), *arguments, "--quick", "--json")[0])

    def test_tells_the_facts_and_writes_nothing(self):
        out, err = self.mesogen("check", self.write_case())
        self.assertEqual(err, "")
        for part in ("256", "0.13333", "about 50 neighbours", "1.6 m x 1.6 m", "quintic.so", "sound:", "l_Q / dx",
                     "can be run"):
            self.assertIn(part, out)
        self.assertRegex(out, r"(?m)^  steps +\d+ or more$")
        self.assertRegex(out, r"(?m)^  wall time +\S+ (s|min) or more with \d threads?: \S+ ms a step \(from \d+ steps\)$")
        self.assertRegex(out, r"(?m)^  memory +\S+ MB$")
        self.assertRegex(out, r"(?m)^  disk +\S+ MB: 3 frames of \S+ MB, 2 checkpoints of \S+ MB$")
        self.assertRegex(out, r"(?m)^  sound: .* s   limits the step$")
        self.assertEqual(os.listdir(self.folder), ["case.toml"])

    def test_quick_takes_no_steps(self):
        out, _ = self.mesogen("check", self.write_case(), "--quick")
        self.assertRegex(out, r"(?m)^  wall time +not measured: --quick$")
        self.assertIsNone(self.check()["time"])

    def test_for_programs(self):
        out, _ = self.mesogen("check", self.write_case(), "--json", "--threads", "2")
        told = json.loads(out)
        self.assertEqual(told["scene"]["particles"], 256)
        self.assertEqual(told["numbers"]["core_size"]["unit"], "m")
        self.assertAlmostEqual(told["numbers"]["core_size"]["value"], 0.02**0.5)
        self.assertEqual(told["time"]["threads"], 2)
        self.assertGreaterEqual(told["time"]["timed_steps"], 3)
        parts = ("start", "observing", "writing")
        time = told["time"]
        steps = told["steps"]["steps_at_least"] * time["step"] + time["sortings"] * time["sorting"]
        self.assertAlmostEqual(time["wall"], sum(time[part] for part in parts) + steps, places=6)
        self.assertEqual([plugin["type"] for plugin in told["plugins"]],
                         ["quintic", "periodic_ghosts", "director", "wcsph", "beris_edwards", "active_stress", "flow_statistics"])
        self.assertEqual(told["disk"]["frames"], 3)
        self.assertEqual(told["disk"]["frame"], 256 * (16 + 8 + 16 + 16 + 8 + 8))  # the last two: what pictures show

    def test_predicts_the_steps_of_a_run(self):
        told = self.check()
        self.mesogen("run", self.path("case.toml"), "--output", "out")
        self.assertEqual(told["steps"]["steps_at_least"], mesogen.open(self.path("out")).cost.steps)
        # Steps are cut to end on samples, frames and kept checkpoints: by a tenth of a step, by half of one.
        for setting in ("observers.flow.interval=0.0007", "output.interval=0.021", "output.checkpoint_every=0.0013",
                        "output.checkpoint_times=[0.0301, 0.0302, 0.07]"):
            told = self.check("--set", setting, "--set", "time.step=0.001")
            self.mesogen("run", self.path("case.toml"), "--set", setting, "--set", "time.step=0.001", "--output", "out",
                         "--overwrite", "--quiet")
            self.assertEqual(told["steps"]["steps_at_least"], mesogen.open(self.path("out")).cost.steps, setting)
            stored = [name for _, _, names in os.walk(self.path("out")) for name in names
                      if name.startswith(("checkpoint_", "step"))]
            self.assertEqual(told["disk"]["checkpoints"], len(stored), setting)
        # 0.06 s and 0.060000000002 s are one time, at which both read.
        nearly = ("--set", "observers.flow.interval=0.03", "--set", "output.interval=0.030000000001", "--set",
                  "time.step=0.001")
        self.mesogen("run", self.path("case.toml"), *nearly, "--output", "out", "--overwrite", "--quiet")
        run = mesogen.open(self.path("out"))
        self.assertEqual((self.check(*nearly)["steps"]["steps_at_least"], run.cost.steps), (100, 100))
        self.assertEqual([len(run.times), len(run.series("flow", "v_rms")[0])], [5, 5])
        fixed = self.check("--set", "time.step=1e-3")["steps"]
        self.assertEqual((fixed["fixed"], fixed["steps_at_least"], fixed["binds"]), (True, 100, "time.step of the case"))

    def test_step_shortens_at_the_expected_speed(self):
        told = self.check("--set", "physics.flow.expected_speed=10", "--set", "physics.flow.sound_speed=1")["steps"]
        self.assertEqual(told["binds_at_speed"], "speed: 0.2 dx / |u|")
        self.assertAlmostEqual(told["step_at_speed"], 0.2 * 0.1 / 10)
        self.assertEqual(told["steps_at_least"], 50)
        self.assertLess(told["steps_at_rest"], 50)

    def test_step_that_is_too_long_is_told(self):
        out, _ = self.mesogen("check", self.write_case(), "--set", "time.step=1.0", "--set", "time.end=20.0", "--set",
                              "observers.flow.interval=20.0", "--set", "output.interval=20.0")
        self.assertRegex(out, r"viscosity: \S.* s +(limits the step +)?time\.step is \S+ times as long: the run will break down\n")
        self.assertRegex(out, r"(?m)^  wall time +not measured: the run (broke down|ran away)")
        self.assertIn("case.toml is right, but its run breaks down\n", out)
        # A run of one such step is over before it breaks down.
        short = ("--set", "time.step=1.0", "--set", "observers.flow.interval=1.0", "--set", "output.interval=1.0")
        out, _ = self.mesogen("check", self.write_case(), *short)
        self.assertRegex(out, r"time\.step is \S+ times as long: a longer run would break down\n")
        self.assertIn("case.toml can be run\n", out)
        self.mesogen("run", self.path("case.toml"), *short, "--output", "short")
        out, _ = self.mesogen("check", self.write_case(), "--set", "time.step=1e-6", "--quick")
        self.assertNotIn("break down", out)

    def test_spacing_that_does_not_come_out_is_told(self):
        fitted = "spacing 0.1 m along x, 0.1 m along y, so that whole rows fit the box"
        case = self.write_case(CASE.replace("spacing = 0.1", "spacing = 0.0995"))
        out, _ = self.mesogen("check", case, "--quick")
        self.assertIn(f"spacing 0.0995 m\n                {fitted}\n", out)
        _, err = self.mesogen("run", case, "--output", "out")
        self.assertIn(f"particles.spacing is 0.0995 m: {fitted}\n", err)
        out, _ = self.mesogen("check", self.write_case(), "--quick")
        self.assertNotIn("fit the box", out)

    def test_which_steps_it_will_take(self):
        paper = os.path.join(PROJECT, "cases", "active_turbulence", "paper.toml")
        out, _ = self.mesogen("check", paper, "--quick")
        self.assertIn("stepping        stabilised: 5 stages for order_tensor, 37 stages for velocity\n", out)
        self.assertIn("  sound: 0.25 h / c0 or 2 mu / rho c0^2          0.57971 s\n", out)
        self.assertNotIn("inf", out.partition("numbers")[0])
        steps = json.loads(self.mesogen("check", paper, "--quick", "--json")[0])["steps"]
        self.assertEqual(steps["stepping"], "stabilised")
        self.assertEqual(steps["stages"], {"order_tensor": 5, "velocity": 37})
        self.assertEqual(steps["steps_at_least"], 1600)
        out, _ = self.mesogen("check", paper, "--quick", "--set", "time.stepping=explicit")
        self.assertIn("stepping        explicit\n", out)

    def test_advice_with_what_following_it_changes(self):
        case = self.write_case()
        settings = "time.factor=0.5", "time.stepping=explicit", "run.precision=double"
        arguments = [word for setting in settings for word in ("--set", setting)]
        out, _ = self.mesogen("check", case, "--quick", *arguments)
        self.assertRegex(out, r"(?m)^advice\n(?:.*\n)*  the step is 0\.5 of the stability limit\n"
                              r"      --set time\.factor=1\n"
                              r"      up to 2 times fewer steps; the answer is as good\n"
                              r"      steps 24 -> 12\n")
        told = {one["name"]: one for one in self.check(*arguments)["advice"]}
        self.assertEqual(told["short_step"]["settings"], ["time.factor=1"])
        self.assertEqual(told["short_step"]["steps"], 12)
        followed = self.check(*arguments, "--set", "time.factor=1")
        self.assertEqual(followed["steps"]["steps_at_least"], 12)
        self.assertNotIn("short_step", [one["name"] for one in followed["advice"]])

    def test_advice_that_does_not_go_with_the_case_is_not_given(self):
        small = "--set", "domain.size=[0.6, 0.6]", "--set", "kernel.smoothing_length=0.95"  # a reach of 4 of 6 spacings
        self.assertNotIn("few_neighbours", [one["name"] for one in self.check(*small)["advice"]])
        roomy = "--set", "kernel.smoothing_length=0.95"
        self.assertIn("few_neighbours", [one["name"] for one in self.check(*roomy)["advice"]])

    def test_a_core_below_two_spacings_is_told_with_a_spacing_that_fits(self):
        for settings, fitting in ((["domain.size=[1.6, 0.8]"], 1.6 / 24),  # 23 columns are 11.5 rows
                                  (["particles.spacing=0.08"], 1.6 / 23)):  # 1.77 spacings
            told = self.check(*(word for setting in settings for word in ("--set", setting)))["advice"]
            found = {one["name"]: one["settings"] for one in told}
            self.assertEqual(found["core_under_resolved"], [f"particles.spacing={fitting:.12g}"])

    def test_a_core_that_no_spacing_resolves_is_told(self):
        out, _ = self.mesogen("check", self.write_case(), "--quick", "--set", "physics.nematic.elastic_constant=1e-9")
        self.assertRegex(out, r"(?m)^  the core of a defect, xi, is only 0\.00032 spacings: .*\n"
                              r"      cores of 2 spacings need 1e\+10 particles; instead, choose a smaller box or")

    def test_misspelt_section_is_told_once(self):
        for right, wrong in (("domain", "domian"), ("director", "directr"), ("kernel", "kernal")):
            _, err = self.mesogen("check", self.write_case(CASE.replace(f"[{right}]", f"[{wrong}]")), code=2)
            self.assertRegex(err, rf'^error: \S*case\.toml:\d+:\d+: {wrong}: unknown section or key; did you mean '
                                  rf'"{right}"\?\n$')

    def test_every_case_of_the_project(self):
        cases = [os.path.join(folder, file) for folder, _, files in os.walk(os.path.join(PROJECT, "cases"))
                 for file in files if file.endswith(".toml") and file != "answer.toml"]
        self.assertTrue(cases)
        for case in cases:
            out, _ = self.mesogen("check", case, "--quick")
            self.assertIn("can be run", out)

    def test_run_that_ends_within_the_rehearsal(self):
        # wcsph and elastic stress between walls: it breaks at 9.8 s, and a run to 1 s ends well before.
        case = self.write_case(SOON_OVER)
        out, err = self.mesogen("check", case)
        self.assertEqual(err, "")
        self.assertIn("case.toml can be run\n", out)
        self.assertRegex(out, r"(?m)^  wall time +\S+ (s|min) or more with \d threads?: \S+ ms a step \(from \d+ steps\)$")
        self.mesogen("run", case, "--output", "out", "--quiet")

    def test_steps_without_end_are_told(self):
        case = self.write_case()
        for setting, words in (("time.step=1e-300", r"to 0\.1 s in steps of 1e-300 s \(limit: time\.step of the case\) a "
                                                    r"run takes 1e\+299 steps, and time would stand still before its end"),
                               ("time.end=1e300", r"to 1e\+300 s in steps of \S+ s \(limit: [^)]*\) a run takes \S+e\+30\d "
                                                  r"steps, and time would stand still before its end"),
                               ("time.step=1e-12", r"to 0\.1 s in steps of 1e-12 s \(.*\) a run takes 1e\+11 steps")):
            arguments = ("--set", setting, "--set", "output.interval=1e300", "--set", "observers.flow.interval=1e300")
            out, err = self.mesogen("check", case, "--quick", *arguments)
            self.assertRegex(err, rf"^warning: {words}\n$")
            never = "e+11" not in words.replace("\\", "")
            self.assertIn("is right, but its run would never end" if never else "can be run", out)
            self.assertEqual(len(json.loads(self.mesogen("check", case, "--quick", "--json", *arguments)[0])["warnings"]), 1)
            with subprocess.Popen([MESOGEN, "run", case, "--output", setting, *arguments], cwd=self.folder, text=True,
                                  env=self.environment(), stderr=subprocess.PIPE) as run:
                while not re.search(words, line := run.stderr.readline()):
                    self.assertNotEqual(line, "", "the run ended without a warning")
                run.kill()
        self.assertEqual(self.mesogen("check", case, "--quick")[1], "")


if __name__ == "__main__":
    unittest.main()
