"""check: what is told of a case, for people and for programs, and how well memory is predicted."""

import json
import os
import sys
import unittest

from support import CASE, PROJECT, CommandTest

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
        self.assertRegex(out, r"(?m)^  disk +\S+ MB: 3 frames of \S+ MB, two checkpoints of \S+ MB$")
        self.assertRegex(out, r"(?m)^  sound: .* s   binds$")
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
                         ["quintic", "periodic_ghosts", "wcsph", "beris_edwards", "active_stress", "flow_statistics"])
        self.assertEqual(told["disk"]["frames"], 3)
        self.assertEqual(told["disk"]["frame"], 256 * (16 + 8 + 16 + 16))

    def test_predicts_the_steps_of_a_run(self):
        told = self.check()
        self.mesogen("run", self.path("case.toml"), "--output", "out")
        self.assertEqual(told["steps"]["steps_at_least"], mesogen.open(self.path("out")).cost.steps)
        fixed = self.check("--set", "time.step=1e-3")["steps"]
        self.assertEqual((fixed["fixed"], fixed["steps_at_least"], fixed["binds"]), (True, 100, "time.step of the case"))

    def test_step_shortens_at_the_expected_speed(self):
        told = self.check("--set", "physics.flow.expected_speed=10", "--set", "physics.flow.sound_speed=1")["steps"]
        self.assertEqual(told["binds_at_speed"], "speed: 0.2 dx / |u|")
        self.assertAlmostEqual(told["step_at_speed"], 0.2 * 0.1 / 10)
        self.assertEqual(told["steps_at_least"], 50)
        self.assertLess(told["steps_at_rest"], 50)

    def test_step_that_is_too_long_is_told(self):
        out, _ = self.mesogen("check", self.write_case(), "--set", "time.step=1.0")
        self.assertRegex(out, r"viscosity: \S.* s +(binds +)?time\.step is \S+ times as long: the run will break down\n")
        self.assertRegex(out, r"(?m)^  wall time +not measured: the run (broke down|ran away)")
        self.assertIn("case.toml is right, but its run breaks down\n", out)
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

    def test_advice_with_what_following_it_changes(self):
        case = self.write_case()
        settings = "time.factor=0.5", "run.precision=double"
        arguments = [word for setting in settings for word in ("--set", setting)]
        out, _ = self.mesogen("check", case, "--quick", *arguments)
        self.assertRegex(out, r"(?m)^advice\n(?:.*\n)*  the step is 0\.5 of what is stable\n"
                              r"      --set time\.factor=1\n"
                              r"      up to 2 times fewer steps, and as good an answer\n"
                              r"      steps 23 -> 12\n")
        told = {one["name"]: one for one in self.check(*arguments)["advice"]}
        self.assertEqual(told["short_step"]["settings"], ["time.factor=1"])
        self.assertEqual(told["short_step"]["steps"], 12)
        followed = self.check(*arguments, "--set", "time.factor=1")
        self.assertEqual(followed["steps"]["steps_at_least"], 12)
        self.assertNotIn("short_step", [one["name"] for one in followed["advice"]])

    def test_advice_that_does_not_go_with_the_case_is_not_given(self):
        told = self.check("--set", "domain.size=[1.6, 0.8]")["advice"]  # 23 columns, but 11.5 rows
        self.assertNotIn("core_under_resolved", [one["name"] for one in told])

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


if __name__ == "__main__":
    unittest.main()
