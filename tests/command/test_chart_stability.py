"""chart, of a study of stability: from the file to the map."""

import os
import pathlib
import unittest

from chart_case import ANSWER, CASE, ChartTest

STUDY = """\
title = "Steps that are too long"
kind = "stability"
scene = "scene"
end = 0.6
remedy = "shorter ones"
[common]
"observers.flow.interval" = 0.05
[sweep]
key = "time.factor"
from = 1.0
to = 30.0
scale = "log"
tolerance = 1.0
[across]
key = "physics.flow.viscosity"
name = "viscosity (Pa s)"
values = [0.05, 0.1]
[judge]
energy = 0.05
volume = false
error = false
[variant.default]
[variant.half]
note = "half as far"
"time.end" = 0.3
"""


class Stability(ChartTest):
    def setUp(self):
        super().setUp()
        self.write(STUDY, "study.toml")

    def refusal_of(self, old, new):
        """What is said against the study with other words in it."""
        self.assertIn(old, STUDY)
        return self.refusal(STUDY.replace(old, new)).replace("study.toml: ", "")

    def test_finds_boundaries_and_draws_their_map(self):
        out, err = self.chart()
        found = self.table("out", "boundaries.csv")
        self.assertEqual([(row["variant"], row["physics.flow.viscosity"], row["state"]) for row in found],
                         [(variant, across, "boundary") for variant in ("default", "half") for across in ("0.05", "0.1")])
        for row in found:
            inside, outside = float(row["inside"]), float(row["outside"])
            self.assertLessEqual(1.0, inside)
            self.assertLess(inside, outside)
            self.assertLessEqual(outside / inside, 2.0)
            self.assertTrue(row["how"] and row["reason"])
        for run in self.table("out", "runs.csv"):
            self.assertEqual(run["how"] == "", run["reason"] == "")
        for name in ("map.png", "map.svg"):
            self.assertGreater(os.path.getsize(self.path("out", name)), 5000)

        text = self.read("out", "map.md")
        self.assertIn(text, out)
        self.assertIn("A run fails if mesogen stops it, or by two particles nearer than 0.3 spacings (clumping), a density changed "
                      "by more than 3 % (density), kinetic energy grown by more than 5 % (energy), momentum changed by more than "
                      "1 % of mass x speed (momentum).", text)
        self.assertIn("Remedy: shorter ones", text)
        self.assertIn("Variants: `half`: half as far.", text)
        self.assertRegex(text, r"# default, 0\.05: fails, \w.*\nmesogen run scene/case\.toml --set time\.end=0\.6 --set "
                               r"observers\.flow\.interval=0\.05 --set physics\.flow\.viscosity=0\.05 --set time\.factor=[\d.]+ "
                               r"--output output/default_0\.05_outside --threads 1\n")
        self.assertRegex(err, r" default, 0\.05, time\.factor = 1: holds, ")
        self.assertRegex(err, r" default, 0\.05, time\.factor = 30: FAILS, \w.* at t = [\d.e+-]+ s: ")

        before = pathlib.Path(self.path("out", "map.png")).read_bytes()
        self.assertEqual(self.chart()[1], "")
        self.assertEqual(pathlib.Path(self.path("out", "map.png")).read_bytes(), before)

    def test_a_killed_study_goes_on(self):
        study = self.start("chart", "study.toml", "--output", "out", "--only", "default")
        for _ in range(3):
            study.stderr.readline()
        study.kill()
        study.communicate()
        kept = self.table("out", "runs.csv")
        self.assertGreaterEqual(len(kept), 3)
        self.chart("--quiet", "--only", "default")
        self.assertEqual(self.table("out", "runs.csv")[: len(kept)], kept)
        values = [(row["variant"], row["across"], row["value"]) for row in self.table("out", "runs.csv")]
        self.assertEqual(len(set(values)), len(values))

    def test_a_range_without_a_boundary(self):
        self.write(STUDY.replace("to = 30.0", "to = 1.1"), "study.toml")
        out, _ = self.chart("--only", "default")
        self.assertEqual({row["state"] for row in self.table("out", "boundaries.csv")}, {"holds over the whole range"})
        self.assertEqual(len(self.table("out", "runs.csv")), 4)
        self.assertNotIn("Just inside", out)
        self.write(STUDY.replace("from = 1.0", "from = 29.0"), "study.toml")
        self.chart("--only", "default")
        self.assertEqual({row["state"] for row in self.table("out", "boundaries.csv")}, {"fails over the whole range"})

    def test_list(self):
        out, _ = self.chart("--list", "--only", "half")
        self.assertEqual(out.count("\n"), 2)
        self.assertRegex(out, r"^next     half, 0\.05, 1: \S*mesogen run scene/case\.toml --set time\.end=0\.3 ")

    def test_draw_only_of_nothing(self):
        self.assertEqual(self.chart("--draw-only", code=2)[1], "error: out: nothing has run yet; leave out --draw-only\n")

    def test_what_is_wrong_with_a_study(self):
        self.assertEqual(self.refusal_of('key = "time.factor"\nfrom = 1.0', "form = 0.5"),
                         "errors:\nsweep.key: is missing; it is a text\nsweep.from: is missing; it is a number\n"
                         "sweep.form: no such key; did you mean 'from'?\n")
        self.assertEqual(self.refusal_of("from = 1.0", "from = 0.0"), 'error: sweep.scale: a "log" scale needs from and to above 0\n')
        self.assertEqual(self.refusal_of("to = 30.0", "to = 1.0"), "error: sweep.to: is the same as from\n")
        self.assertEqual(self.refusal_of("tolerance = 1.0", 'tolerance = 1.0\ntemplate = "[{}, {}]"'),
                         'error: sweep.template: must be a value of TOML with one {} where the number goes, such as "[{}, 1.0]"\n')
        self.assertEqual(self.refusal_of("values = [0.05, 0.1]", "values = []"),
                         "error: across.values: must be a list of one or more numbers or texts\n")
        self.assertEqual(self.refusal_of("energy = 0.05", "enrgy = 0.05"), "error: judge.enrgy: no such key; did you mean 'energy'?\n")
        self.assertEqual(self.refusal_of("energy = 0.05", "energy = true"), "error: judge.energy: must be a number above 0\n")
        self.assertEqual(self.refusal_of('"time.end" = 0.3', '"time.factor" = 0.2'),
                         'error: variant.half."time.factor": is swept; leave it out\n')

    def test_an_answer_beyond_the_end(self):
        self.write(ANSWER.replace("at = [0.2]", "at = [0.7]"), "scene/answer.toml")
        self.assertEqual(self.refusal_of("error = false", "error = 0.2"),
                         "error: end: the scene's answer is for t = 0.7 s; run to there, or say error = false in [judge]\n")
        os.remove(self.path("scene", "answer.toml"))
        self.assertEqual(self.refusal_of("error = false", "error = 0.2"),
                         "error: judge.error: there is no answer.toml beside the case to compare with; leave it out\n")

    def test_what_mesogen_refuses(self):
        err = self.refusal_of('key = "time.factor"', 'key = "time.facto"')
        self.assertIn('default, 0.05, time.facto = 1; default, 0.05, time.facto = 30; default, 0.1, time.facto = 1; ', err)
        self.assertIn('--set: time.facto: unknown key; did you mean "factor"?', err)

    def test_a_case_without_flow_statistics(self):
        self.write(CASE.replace("[observers.flow]\ntype = \"flow_statistics\"", "[observers.flow]\ntype = \"pathlines\""), "scene/case.toml")
        self.write(STUDY, "study.toml")
        _, err = self.chart(code=2)
        self.assertIn("the case has no observer of type flow_statistics, by which runs are judged; add one to the case", err)
        self.assertFalse(os.path.exists(self.path("out", "runs.csv")), "nothing was run")


if __name__ == "__main__":
    unittest.main()
