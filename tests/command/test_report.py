"""report: pictures of a run, and clear words where there are none."""

import os
import shutil
import subprocess
import unittest

from support import MESOGEN, CommandTest


class Report(CommandTest):
    def test_pictures(self):
        self.mesogen("run", self.write_case(), "--output", "out", "--quiet")
        out, _ = self.mesogen("report", "out")
        self.assertIn("director.png", out)
        for name in ("director", "vorticity", "series"):
            with open(self.path("out", "report", name + ".png"), "rb") as file:
                self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")
        self.mesogen("report", "out", "--frame", "-2", "--output", "elsewhere")
        self.assertTrue(os.path.exists(self.path("elsewhere", "director.png")))

    def test_several_frames(self):
        self.mesogen("run", self.write_case(), "--output", "out", "--quiet")
        self.mesogen("report", "out", "--frames", "-2:-1", "--every", "1", "--output", "pictures")
        names = sorted(name for name in os.listdir(self.path("pictures")) if name.startswith("director"))
        self.assertEqual(names, ["director_000001.png", "director_000002.png"])
        _, err = self.mesogen("report", "out", "--frame", "1", "--frames", "0:1", code=2)
        self.assertIn("mesogen report: --frame excludes --frames: give one of them", err)
        _, err = self.mesogen("report", "out", "--frames", "0-1", code=2)
        self.assertIn("'0-1' must be A:B, such as 10:20, 10: or :-5", err)

    def test_no_results(self):
        _, err = self.mesogen("report", "nothing", code=2)
        self.assertRegex(err, r"^error: nothing: ")

    def test_folder_whose_name_looks_like_an_option(self):
        self.mesogen("run", self.write_case(), "--output", "./-out", "--quiet")
        self.mesogen("report", "./-out")
        self.assertTrue(os.path.exists(self.path("-out", "report", "director.png")))

    def test_missing_python_package(self):
        os.mkdir(self.path("bin"))
        shutil.copy(MESOGEN, self.path("bin", "mesogen"))
        done = subprocess.run([self.path("bin", "mesogen"), "report", "out"], env=self.environment(), text=True,
                              capture_output=True, check=False)
        self.assertEqual(done.returncode, 1)
        missing = os.path.join(self.folder, "lib", "mesogen", "python")
        self.assertIn(f"the Python package is missing: {missing} is not there", done.stderr)


if __name__ == "__main__":
    unittest.main()
