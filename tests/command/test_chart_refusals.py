"""chart: studies and answers that are wrong."""

import unittest

from chart_case import ANSWER, STUDY, ChartTest


class Refusals(ChartTest):
    """Studies and answers that are wrong."""

    def test_no_study(self):
        _, err = self.mesogen("chart", "nothing.toml", code=2)
        self.assertEqual(err, "error: nothing.toml: the study cannot be read: No such file or directory\n")

    def test_no_toml(self):
        self.assertRegex(self.refusal("title = \n"), r"^error: study\.toml: the study is not TOML: .*line 1")

    def test_kinds(self):
        self.assertEqual(self.refusal(STUDY.replace('"accuracy"', '"acuracy"')),
                         "error: study.toml: kind: 'acuracy' is none of: accuracy, stability; did you mean 'accuracy'?\n")
        self.assertEqual(self.refusal(STUDY.replace('kind = "accuracy"', "")),
                         "error: study.toml: kind: is missing; it is one of: accuracy, stability\n")

    def test_all_that_is_wrong_at_once(self):
        wrong = STUDY.replace("repeats = 2", 'repeat = 2\nthreads = 0\nresolutions = [8, 8]').replace("resolutions = [8, 12, 16]\n", "")
        wrong += '"kernel" = { type = "quintic" }\nfactor = 1\n"particles.spacing" = 0.1\n"time.step" = nan\n'
        self.assertEqual(self.refusal(wrong).splitlines(), [
            "errors:",
            "study.toml: resolutions: must be a list of different whole numbers, each at least 2",
            "study.toml: threads: must be a whole number, at least 1",
            'study.toml: variant.short.kernel: is a table; write its keys as one dotted, quoted key each, as for --set: '
            '"kernel.KEY" = VALUE',
            'study.toml: variant.short.factor: is no dotted key of a case such as "kernel.type", nor is it one of: note, '
            "resolutions",
            'study.toml: variant.short."time.step": must be a number, a text, true or false, or a list of them',
            'study.toml: variant.short."particles.spacing": is chosen by the resolutions; leave it out',
            "study.toml: repeat: no such key; did you mean 'repeats'?",
        ])

    def test_no_variant(self):
        self.assertEqual(self.refusal(STUDY[: STUDY.index("[variant")]),
                         "error: study.toml: variant: is missing; it is one or more tables [variant.NAME]\n")

    def test_variants_of_a_file(self):
        self.write('[variant.wendland_c4]\n"kernel.type" = "wendland_c4"\n', "shared.toml")
        shares = STUDY.replace("repeats = 2", 'repeats = 2\nvariants_from = ["shared.toml"]')
        self.write(shares, "study.toml")
        names = [line.split()[1] for line in self.chart("--list")[0].splitlines()]
        self.assertEqual(names[:4], ["wendland_c4", "default", "wendland_c2", "short"])
        self.write(shares[: shares.index("[variant")], "study.toml")  # none of its own
        self.assertEqual({line.split()[1] for line in self.chart("--list")[0].splitlines()}, {"wendland_c4"})

    def test_variants_of_a_file_that_do_not_fit(self):
        self.write('title = "x"\n[variant.default]\n', "shared.toml")
        wrong = STUDY.replace("repeats = 2", 'repeats = 2\nvariants_from = ["shared.toml", "none.toml"]')
        self.assertEqual(self.refusal(wrong).splitlines(), [
            "errors:",
            "shared.toml: title: no such key; there are: variant",
            "study.toml: variants_from: none.toml: the variants cannot be read: No such file or directory",
            "study.toml: variant.default: is also in shared.toml; give one of them another name",
        ])
        self.assertEqual(self.refusal(STUDY.replace("repeats = 2", 'repeats = 2\nvariants_from = "shared.toml"')),
                         "error: study.toml: variants_from: must be a list of different texts\n")

    def test_no_scene(self):
        self.assertEqual(self.refusal(STUDY.replace('"scene"', '"scenes"')),
                         "error: study.toml: scene: scenes: the scene's case cannot be read: No such file or directory\n")

    def test_an_answer_that_is_wrong(self):
        self.write(ANSWER.replace('"flow.v_rms"', '"v_rms"').replace('"value"', '"values"').replace("[0.476438]", "0.47"),
                   "scene/answer.toml")
        self.assertEqual(self.refusal(STUDY).splitlines(), [
            "errors:",
            "scene/answer.toml: quantity[1].series: 'v_rms' must be OBSERVER.QUANTITY, the observer as the case names it",
            "scene/answer.toml: quantity[1].measure: 'values' is none of: value, growth_rate; did you mean 'value'?",
            "scene/answer.toml: quantity[1].exact: must be a list of one or more numbers",
        ])
        self.write(ANSWER.replace("[0.476438]", "[0.47, 0.0]"), "scene/answer.toml")
        self.assertEqual(self.refusal(STUDY), "error: scene/answer.toml: quantity[1].exact: must be a list of 1 numbers\n")
        self.write(ANSWER.replace("[0.476438]", "[0.0]"), "scene/answer.toml")
        self.assertEqual(self.refusal(STUDY), "error: scene/answer.toml: quantity[1].exact: is 0, so that the error cannot be "
                                              "relative to it: give a scale\n")

    def test_an_answer_about_what_is_not_recorded(self):
        self.write(ANSWER.replace("flow.v_rms", "flow.speed"), "scene/answer.toml")
        wrong = "scene/answer.toml: quantity[1].series: observer 'flow' records no 'speed'; there are: "
        self.assertIn(wrong, self.refusal(STUDY))
        self.write(ANSWER.replace("flow.v_rms", "flaw.v_rms"), "scene/answer.toml")
        self.assertIn("scene/answer.toml: quantity[1].series: the case has no observer 'flaw'; did you mean 'flow'?",
                      self.refusal(STUDY))

    def test_what_mesogen_refuses(self):
        err = self.refusal(STUDY + '"kernel.typ" = "quintic"\n[variant.cubic]\n"kernel.type" = "cubic"\n')
        self.assertEqual(err.splitlines()[:2], [
            "errors:", 'study.toml: variant.short: --set: kernel.typ: unknown key; did you mean "type"?'])
        self.assertIn('study.toml: variant.cubic: --set: kernel.type: no kernel plugin is called "cubic"', err)


if __name__ == "__main__":
    unittest.main()
