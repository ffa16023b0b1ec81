"""Disks that are full, folders that are gone or forbidden: what was written stays readable, and the error says what to do."""

import os
import resource
import shutil
import signal
import stat
import subprocess
import time
import unittest

import h5py
import numpy
from support import CASE, MESOGEN, CommandTest

LONG = CASE.replace("end = 0.1", "end = 500.0").replace("[output]\ninterval = 0.05", "[output]\ninterval = 0.02")
NOBODY = 65534


class Storage(CommandTest):
    def failure(self, process, code=1):
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, code, err)
        return err

    def frames(self, folder):
        """Number of frames, all of them readable."""
        with h5py.File(self.path(folder, "results.h5"), "r") as file:
            value = numpy.asarray(file["particles/fluid/velocity/value"])
        self.assertTrue(numpy.isfinite(value).all())
        return len(value)

    def test_disk_that_is_full(self):
        # A limit on the size of files meets results.h5 when it has grown; the answer of a full disk is the same but for
        # its first words.
        process = self.start("run", self.write_case(LONG), "--output", "out")
        self.wait_for(process, "out")
        resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (80000, resource.RLIM_INFINITY))
        err = self.failure(process)
        self.assertRegex(err, r"error: cannot write out/(results|checkpoint_[ab])\.\w+: File too large; what was written "
                              r"before is safe: make room, then `mesogen resume` continues the run\n$")
        self.assertNotIn("warning", err)
        self.assertGreater(self.frames("out"), 0)
        process = self.start("resume", "out")
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        self.assertIn("resuming from", self.failure(process, code=130))

    def test_folder_that_is_removed(self):
        process = self.start("run", self.write_case(LONG), "--output", "out")
        self.wait_for(process, "out", "frames", "000003.h5")
        while os.path.exists(self.path("out")):  # the run makes new files while the others go
            shutil.rmtree(self.path("out"), ignore_errors=True)
        self.assertRegex(self.failure(process), r"error: cannot (write|read) out/.*: No such file or directory; has its "
                                                r"folder been removed or renamed\?\n$")

    def test_folder_that_is_renamed(self):
        process = self.start("run", self.write_case(LONG), "--output", "out")
        self.wait_for(process, "out", "frames", "000003.h5")
        os.rename(self.path("out"), self.path("elsewhere"))
        self.assertIn("has its folder been removed or renamed?", self.failure(process))
        self.assertGreaterEqual(self.frames("elsewhere"), 3)

    def forbid(self, *parts):
        """Makes a folder read-only; what runs the command then is not root."""
        folder = self.path(*parts)
        before = os.stat(folder).st_mode
        os.chmod(folder, stat.S_IRUSR | stat.S_IXUSR | stat.S_IRGRP | stat.S_IXGRP | stat.S_IROTH | stat.S_IXOTH)
        self.addCleanup(os.chmod, folder, before)
        if os.geteuid() != 0:
            return {}
        os.chmod(self.folder, 0o755)
        able = subprocess.run([MESOGEN, "--version"], user=NOBODY, capture_output=True, check=False)
        if able.returncode != 0:
            self.skipTest("nobody but root may run the command here")
        return {"user": NOBODY}

    def test_folder_that_is_forbidden(self):
        os.mkdir(self.path("closed"))
        case = self.write_case(LONG)
        how = self.forbid("closed")
        for folder in ("closed/out", "closed/a/b"):
            err = self.failure(self.start("run", case, "--output", folder, **how), code=2)
            self.assertRegex(err, rf"error: cannot .* {folder}.*: Permission denied; check its permissions, or choose "
                                  r"another folder with --output\n$")

    def test_run_whose_folder_becomes_forbidden(self):
        process = self.start("run", self.write_case(LONG), "--output", "out")
        self.wait_for(process, "out", "checkpoint_a.h5")
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
        how = self.forbid("out")
        err = self.failure(self.start("resume", "out", **how), code=2)
        self.assertRegex(err, r"error: cannot .*out/.*: Permission denied; check its permissions")
        self.assertGreater(self.frames("out"), 0)


if __name__ == "__main__":
    unittest.main()
