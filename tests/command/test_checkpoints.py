"""resume with checkpoints that cannot be used."""

import os
import random
import shutil
import unittest

import checkpoints
import h5py
import numpy
from support import BROKEN_PLUGINS, CASE, CommandTest
from test_branch import KEEPING
from test_extend import fingerprint

SHORT = CASE.replace("[output]", "[output]\ncheckpoint_interval = 0.001").replace(
    "end = 0.1", "end = 0.2").replace("[observers.flow]\ntype = \"flow_statistics\"\ninterval = 0.05\n", "")


class BadCheckpoints(CommandTest):
    def setUp(self):
        super().setUp()
        # Complete, but without its end: what a run leaves that was killed after two checkpoints.
        self.case = self.write_case(SHORT)
        self.mesogen("run", self.case, "--output", "unbroken", "--quiet")
        shutil.copytree(self.path("unbroken"), self.path("out"))
        self.newest, self.older = checkpoints.newest(self.path("out"))
        with open(self.newest, "rb") as file:
            self.whole = file.read()

    def damage(self, data):
        with open(self.newest, "wb") as file:
            file.write(data)

    def expect_older_is_used(self, reason):
        _, err = self.mesogen("resume", "out")
        self.assertIn(f"warning: {os.path.basename(self.newest)}: {reason}", err)
        self.assertIn(f"resuming from {os.path.basename(self.older)} at t = ", err)
        finals = []
        for folder in ("unbroken", "out"):
            with h5py.File(self.path(folder, "results.h5"), "r") as file:
                finals.append({name: numpy.asarray(file[f"particles/fluid/{name}/value"])
                               for name in ("position", "velocity", "order_tensor")})
        for name, expected in finals[0].items():
            self.assertTrue(numpy.array_equal(expected, finals[1][name]), name)

    def test_truncated(self):
        self.damage(self.whole[:4096])
        self.expect_older_is_used(f"truncated: it has 4096 bytes of {len(self.whole)}")

    def test_flipped_bytes(self):
        chance = random.Random(1)
        for _ in range(3):
            shutil.rmtree(self.path("out"))
            shutil.copytree(self.path("unbroken"), self.path("out"))
            data = bytearray(self.whole)
            data[chance.randrange(checkpoints.SEAL, len(data))] ^= 1 << chance.randrange(8)
            self.damage(data)
            self.expect_older_is_used("damaged: its checksum does not match its bytes")

    def test_of_another_version(self):
        def edit(file):
            del file["version"]
            file.create_dataset("version", data="9.9.9", dtype=h5py.string_dtype())

        checkpoints.change(self.newest, edit)
        self.expect_older_is_used("it was written by version 9.9.9, this is ")

    def test_of_another_layout(self):
        checkpoints.change(self.newest, lambda file: file.__delitem__("integers"))
        self.expect_older_is_used("not a checkpoint that this version reads: cannot find group integers")

    def test_none_that_can_be_used(self):
        self.damage(self.whole[:4096])
        with open(self.older, "r+b") as file:
            file.seek(2000)
            file.write(b"x" * 8)
        third = self.path("out", "checkpoint_before_end.h5")  # where the end is no time asked for
        if os.path.exists(third):
            os.remove(third)
        before = os.stat(self.path("out", "results.h5")).st_mtime_ns
        _, err = self.mesogen("resume", "out", code=2)
        self.assertIn("no checkpoint in out can be used:", err)
        self.assertIn(f"{os.path.basename(self.newest)}: truncated: it has 4096 bytes of {len(self.whole)}", err)
        self.assertIn(f"{os.path.basename(self.older)}: damaged: its checksum does not match its bytes", err)
        self.assertEqual(os.stat(self.path("out", "results.h5")).st_mtime_ns, before, "results were touched")

    def test_of_another_case(self):
        with open(self.path("out", "case.toml"), "r+", encoding="utf-8") as file:
            text = file.read()
            file.seek(0)
            file.write(text.replace("viscosity = 0.5", "viscosity = 0.6"))
        _, err = self.mesogen("resume", "out", code=2)
        for name in ("checkpoint_a.h5", "checkpoint_b.h5"):
            self.assertIn(f"{name}: it belongs to another case than case.toml", err)


class CheckpointsThatCannotBeRestored(CommandTest):
    """Nothing makes way before the run goes on: the restore may yet fail."""

    def setUp(self):
        super().setUp()
        self.mesogen("run", self.write_case(KEEPING), "--output", "out", "--quiet")
        self.kept = sorted(os.listdir(self.path("out", "checkpoints")))

    def expect_untouched(self, expected, *arguments, code=2):
        def files():
            return {file: facts for file, facts in fingerprint(self.path("out")).items() if not file.endswith("run.log")}

        before = files()
        _, err = self.mesogen("resume", "out", *arguments, code=code)
        self.assertIn(expected, err)
        self.assertEqual(files(), before)

    def test_an_observer_is_missing(self):
        newest, older = checkpoints.newest(self.path("out"))
        os.remove(older)
        shutil.copy(self.path("out", "checkpoints", self.kept[1]), newest)  # all others are kept since
        checkpoints.change(newest, lambda file: file["observers"].__delitem__("flow"))
        self.expect_untouched("the checkpoint knows no observer 'flow'", "--set", "time.end=0.25")

    def test_a_plugin_that_fails_as_it_starts_again(self):
        # The checkpoints that a run goes on from are lost; those that it kept are not.
        for name in os.listdir(self.path("out")):
            if name.startswith("checkpoint_"):
                os.remove(self.path("out", name))
        with open(self.path("out", "case.toml"), "a", encoding="utf-8") as file:
            file.write('[observers.bad]\ntype = "misbehaving"\nmisdeed = "start throws"\n')
        self.expect_untouched("not yet", "--plugin-path", os.path.join(BROKEN_PLUGINS, "misbehaving"), code=1)


if __name__ == "__main__":
    unittest.main()
