"""The studies that come with Mesogen: each can be read, and mesogen takes every variant of it."""

import glob
import os
import shlex
import unittest

from support import PROJECT, CommandTest

STUDIES = sorted(file for kind in ("accuracy", "stability")
                 for file in glob.glob(os.path.join(PROJECT, "studies", kind, "*.toml")))
PAPER = os.path.join(PROJECT, "studies", "paper")
SWEEPS = sorted(file for file in glob.glob(os.path.join(PAPER, "*.toml"))
                if os.path.basename(file) not in ("case.toml", "study.toml"))


class Studies(CommandTest):
    def test_each_can_be_run(self):
        self.assertGreaterEqual(len(STUDIES), 8)
        for study in STUDIES:
            with self.subTest(os.path.relpath(study, PROJECT)):
                out, _ = self.mesogen("chart", study, "--list", "--output", "out")
                self.assertIn("mesogen run ", out)

    def test_sweeps_of_the_paper_can_be_run(self):
        self.assertGreaterEqual(len(SWEEPS), 8)
        for sweep in SWEEPS:
            with self.subTest(os.path.basename(sweep)):
                out, _ = self.mesogen("sweep", sweep, "--list", "--output", "out")
                for line in out.splitlines():
                    words = shlex.split(line.split(": ", 1)[1])
                    settings = [word for at, word in enumerate(words) if word == "--set" or words[at - 1] == "--set"]
                    self.mesogen("graph", os.path.join(PAPER, "case.toml"), *settings)

    def test_sections_of_the_paper_can_be_read(self):
        for mode in ("--quick", "--full", None):
            _, err = self.mesogen("study", PAPER, "--write-only", "--output", "out", *([mode] if mode else []), code=1)
            self.assertIn("was not run", err)
            self.assertNotRegex(err, "left out: .*[a-z]Error")


if __name__ == "__main__":
    unittest.main()
