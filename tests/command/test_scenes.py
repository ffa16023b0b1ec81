"""The scenes with a known answer, cases/accuracy: each answer.toml is complete and fits what its case records."""

import os
import sys
import tomllib
import unittest

import h5py
from support import PROJECT, CommandTest

sys.path.insert(0, os.path.join(PROJECT, "python"))
from mesogen.charts.measures import MEASURES  # noqa: E402

SCENES = os.path.join(PROJECT, "cases", "accuracy")
NAMES = sorted(os.listdir(SCENES))


def read(name, file):
    with open(os.path.join(SCENES, name, file), "rb") as opened:
        return tomllib.load(opened)


class Scenes(CommandTest):
    def test_the_scenes_are_there(self):
        self.assertLessEqual({"taylor_green", "shear_wave", "bend_growth", "splay_growth", "benchmark",
                              "flow_alignment", "relaxation", "defect_pair"}, set(NAMES))

    def test_answers_are_complete(self):
        for name in NAMES:
            with self.subTest(name):
                case, answer = read(name, "case.toml"), read(name, "answer.toml")
                self.assertLessEqual(set(answer), {"title", "source", "across", "quantity"})
                self.assertGreater(len(answer["title"]), 5)
                self.assertGreater(len(answer["source"]), 20)
                self.assertIn(answer["across"], case["domain"]["size"])
                self.assertTrue(answer["quantity"])
                for quantity in answer["quantity"]:
                    self.check_quantity(case, quantity)

    def check_quantity(self, case, quantity):
        self.assertLessEqual(set(quantity), {"series", "measure", "at", "exact", "scale"})
        self.assertIn(quantity["measure"], MEASURES)
        observer = case["observers"][quantity["series"].split(".")[0]]
        self.assertEqual(quantity["at"], sorted(quantity["at"]))
        self.assertLessEqual(quantity["at"][-1], case["time"]["end"])
        # samples come at the first step after each interval: close enough to interpolate between them
        self.assertLessEqual(observer["interval"], case["time"]["end"] / 5.0)
        self.assertEqual(len(quantity["exact"]), MEASURES[quantity["measure"]].count(quantity["at"]))
        self.assertTrue(all(quantity["exact"]) or "scale" in quantity)
        self.assertGreater(quantity.get("scale", 1.0), 0.0)

    def test_cases_record_what_the_answers_name(self):
        for name in NAMES:
            with self.subTest(name):
                answer = read(name, "answer.toml")
                self.mesogen("run", os.path.join(SCENES, name, "case.toml"), "--quiet", "--output", name, "--set",
                             f"particles.spacing={answer['across'] / 24.0!r}", "--set", "time.end=1e-6")
                with h5py.File(self.path(name, "results.h5"), "r") as file:
                    for quantity in answer["quantity"]:
                        series = file["observables/" + quantity["series"].replace(".", "/")]["value"]
                        self.assertEqual(series.size, series.shape[0], "one number a sample")
                        self.assertTrue(series[-1] == series[-1], "a number")


if __name__ == "__main__":
    unittest.main()
