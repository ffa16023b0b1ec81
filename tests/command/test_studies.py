"""The studies that come with Mesogen: each can be read, and mesogen takes every variant of it."""

import glob
import os
import unittest

from support import PROJECT, CommandTest

STUDIES = sorted(glob.glob(os.path.join(PROJECT, "studies", "*", "*.toml")))


class Studies(CommandTest):
    def test_each_can_be_run(self):
        self.assertGreaterEqual(len(STUDIES), 8)
        for study in STUDIES:
            with self.subTest(os.path.relpath(study, PROJECT)):
                out, _ = self.mesogen("chart", study, "--list", "--output", "out")
                self.assertIn("mesogen run ", out)


if __name__ == "__main__":
    unittest.main()
