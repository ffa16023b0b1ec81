"""Folders for output that hold files of somebody else's: nothing is written among them."""

import os
import unittest

from chart_case import ANSWER, STUDY
from chart_case import CASE as SCENE
from support import CommandTest
from sweep_case import CASE as SWEPT
from sweep_case import SWEEP

REFUSED = r"^error: used is not empty and holds nothing of ours: choose another --output, such as a new folder in it\n$"


class OutputFolders(CommandTest):
    def setUp(self):
        super().setUp()
        os.makedirs(self.path("used", "bin"))

    def refused(self, *arguments, words=REFUSED):
        _, err = self.mesogen(*arguments, "--output", "used", code=2)
        self.assertRegex(err, words)
        self.assertEqual(os.listdir(self.path("used")), ["bin"], "something was written")

    def test_of_a_run(self):
        case = self.write_case()
        words = "error: used is not empty and holds no run: choose another --output, such as a new folder in it\n"
        for more in ([], ["--overwrite"]):
            self.refused("run", case, *more, words=f"^{words}$")
        self.assertEqual(self.mesogen("run", case, "-o", "/", code=2)[1], words.replace("used", "/"))
        self.mesogen("run", case, "--output", "used/new", "--quiet")

    def test_of_pictures(self):
        self.mesogen("run", self.write_case(), "--output", "out", "--quiet")
        self.refused("report", "out")
        for _ in range(2):  # what it wrote itself it writes anew
            self.mesogen("report", "out", "--output", "pictures")

    def test_of_a_chart(self):
        self.write(SCENE, "scene", "case.toml")
        self.write(ANSWER, "scene", "answer.toml")
        self.write(STUDY, "study.toml")
        self.refused("chart", "study.toml", "--only", "short")
        for _ in range(2):
            self.mesogen("chart", "study.toml", "--only", "short", "--output", "charts")

    def test_of_a_sweep(self):
        self.write(SWEPT, "case.toml")
        self.write(SWEEP, "sweep.toml")
        for more in ([], ["--collect-only"], ["--slurm", "--dry-run"]):
            self.refused("sweep", "sweep.toml", *more)


if __name__ == "__main__":
    unittest.main()
