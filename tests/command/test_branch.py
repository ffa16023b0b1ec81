"""branch: a new run from a checkpoint of another."""

import fcntl
import os
import shutil
import signal
import unittest

import checkpoints
import h5py
import numpy
from support import BROKEN_PLUGINS, CASE, CommandTest
from test_extend import fingerprint

# Steps of 1/256 s: every time that is asked for is a multiple, without rounding.
KEEPING = CASE.replace("[time]\nend = 0.1", "[time]\nstep = 0.00390625\nend = 0.125").replace(
    "interval = 0.05", "interval = 0.03125").replace(
    "[output]", "[output]\ncheckpoint_times = [0.046875]\ncheckpoint_every = 0.03125")
INCOMPRESSIBLE = KEEPING.replace('type = "wcsph"', 'type = "incompressible"')


class Branches(CommandTest):
    def setUp(self):
        super().setUp()
        self.mesogen("run", self.write_case(KEEPING), "--output", "out", "--quiet")

    def kept(self, folder="out"):
        return sorted(os.listdir(self.path(folder, "checkpoints")))

    def last(self, folder):
        with h5py.File(self.path(folder, "results.h5"), "r") as file:
            return {name: numpy.asarray(file[f"particles/fluid/{name}/value"][-1])
                    for name in ("position", "velocity", "order_tensor")}

    def same(self, folder, other):
        one, two = self.last(folder), self.last(other)
        return all(numpy.array_equal(one[name], two[name]) for name in one)

    def refused(self, *arguments):
        _, err = self.mesogen("branch", "out", "new", *arguments, code=2)
        self.assertFalse(os.path.exists(self.path("new")))
        return err

    def test_checkpoints_are_kept_at_their_times(self):
        self.assertEqual(self.kept(), ["step0000000008_t0.03125.h5", "step0000000012_t0.046875.h5",
                                       "step0000000016_t0.0625.h5", "step0000000024_t0.09375.h5",
                                       "step0000000032_t0.125.h5"])

    def test_with_the_same_parameters_it_is_the_same_run(self):
        for flow, text in (("out", KEEPING), ("incompressible", INCOMPRESSIBLE)):
            if flow != "out":
                self.mesogen("run", self.write_case(text), "--output", flow, "--quiet")
            before = fingerprint(self.path(flow))
            self.mesogen("branch", flow, f"{flow}-new", "--at", "0.0625", "--quiet")
            self.assertTrue(self.same(flow, f"{flow}-new"), flow)
            self.assertEqual(fingerprint(self.path(flow)), before)

    def test_results_begin_at_the_branch_and_say_where_they_come_from(self):
        self.mesogen("branch", "out", "new", "--at", "0.0625", "--set", "time.end=0.09375", "--set",
                     "physics.activity.activity=-0.05", "--quiet")
        with h5py.File(self.path("new", "results.h5"), "r") as file, \
                h5py.File(self.path("out", "results.h5"), "r") as old:
            for group in ("particles/fluid/position", "observables/flow/v_rms"):
                self.assertEqual(list(file[group]["time"]), [0.0625, 0.09375])
            self.assertTrue(numpy.array_equal(file["particles/fluid/position/value"][0],
                                              old["particles/fluid/position/value"][2]))
            origin = {name: value.decode() if isinstance(value, bytes) else value
                      for name, value in file["parameters/branched_from"].attrs.items()}
            self.assertEqual(file["parameters/cost"].attrs["steps"], 8)
            self.assertIn("activity = -0.05", file["parameters/case"][()].decode())
        self.assertEqual(origin, {"folder": self.path("out"), "checkpoint": "checkpoints/step0000000016_t0.0625.h5",
                                  "time": 0.0625, "step": 16,
                                  "changes": "time.end=0.09375\nphysics.activity.activity=-0.05"})

    def test_other_parameters_take_effect(self):
        for number, change in enumerate(("physics.activity.activity=-0.05", "kernel.type=wendland_c2",
                                         "kernel.smoothing_length=1.6", "run.precision=single", "time.step=0.002",
                                         "domain.boundary=periodic_wrap")):
            self.mesogen("branch", "out", f"new{number}", "--at", "0.0625", "--set", change, "--quiet")
            if change != "domain.boundary=periodic_wrap":  # the same to rounding
                self.assertFalse(self.same("out", f"new{number}"), change)
            for name, values in self.last(f"new{number}").items():
                self.assertLess(numpy.abs(values - self.last("out")[name]).max(), 0.1, f"{change}: {name}")

    def test_from_the_newest_checkpoint(self):
        err = self.refused()
        self.assertIn("time.end: must be later than the branch, t = 0.125 s, but is 0.125 s: give a later end, "
                      "such as --set time.end=0.25", err)
        self.mesogen("branch", "out", "new", "--set", "time.end=0.1875", "--quiet")
        self.mesogen("resume", "out", "--set", "time.end=0.1875", "--quiet")
        self.assertTrue(self.same("out", "new"))

    def test_a_branch_is_extended_and_keeps_its_origin(self):
        self.mesogen("branch", "out", "new", "--at", "0.0625", "--quiet")
        self.mesogen("resume", "new", "--set", "time.end=0.1875", "--quiet")
        self.mesogen("resume", "out", "--set", "time.end=0.1875", "--quiet")
        self.assertTrue(self.same("out", "new"))
        with h5py.File(self.path("new", "results.h5"), "r") as file:
            self.assertEqual(file["parameters/branched_from"].attrs["step"], 16)
            self.assertEqual(file["parameters/cost"].attrs["steps"], 32)

    def test_one_that_broke_off_at_once_goes_on_from_its_branch(self):
        # As after a kill before the first frame: the folder is there with its case and the checkpoint alone.
        observer = 'observers.bad={type="misbehaving", misdeed="sample throws"}'
        for verb in (["branch", "out", "new", "--at", "0.0625", "--set", observer], ["resume", "new"]):
            _, err = self.mesogen(*verb, "--plugin-path", os.path.join(BROKEN_PLUGINS, "misbehaving"), code=1)
            self.assertIn("step 16, t = 0.0625", err)

    def test_times_without_a_checkpoint(self):
        err = self.refused("--at", "0.06")
        self.assertIn("out holds no checkpoint at t = 0.06 s. ", err)
        self.assertIn("at t = 0.0625, 0.046875, 0.03125, 0.09375, 0, 0.125 s. ", err)
        self.assertIn("A run with output.checkpoint_times = [0.06] keeps one there", err)

    def test_what_the_particles_fix_is_refused_by_name(self):
        particles = "is about how a box is filled, and a branch goes on with the particles of the checkpoint"
        start = "has an effect only at the start of a run, and a branch goes on with what the particles of the"
        for change, expected in (
                ("domain.size=[3.2, 1.6]", "domain.size: cannot change at a branch: it is that of the particles in"),
                ("particles.spacing=0.05", f"particles.spacing: cannot change at a branch: it {particles}"),
                ("particles.seed=2", f"particles.seed: cannot change at a branch: it {particles}"),
                ('solids.pillar={shape="disc", centre=[0.8, 0.8], radius=0.3}',
                 "solids.pillar.centre: cannot change at a branch: it says where the solid is, and a branch goes on"),
                ("director.order=0.5", f"director.order: cannot change at a branch: it {start}"),
                ("colour.type=quarter", f"colour.type: cannot change at a branch: it {start}"),
                ("domain.boundary={type=\"walls\"}", "domain.boundary: cannot change from periodic faces to walls"),
                ('physics.flow={type="incompressible", density=1.0, viscosity=0.5}',
                 "physics: a branch has the fields that the run advances, no more and no fewer, but acceleration, "
                 "compression would have no plugin that advances them"),
                ('physics.flow={type="incompressible", density=1.0, viscosity=0.5}',
                 'physics.flow: goes on from 240 numbers ("velocity") and the checkpoint has 0: keep the plugin')):
            self.assertIn(expected, self.refused("--at", "0.0625", "--set", change), change)

    def test_a_folder_in_use_and_one_that_is_no_run(self):
        shutil.copytree(self.path("out"), self.path("other"))
        before = fingerprint(self.path("other"))
        _, err = self.mesogen("branch", "out", "other", "--at", "0.0625", code=2)
        self.assertIn("other already holds a run", err)
        self.assertEqual(fingerprint(self.path("other")), before)
        self.mesogen("branch", "out", "other", "--at", "0.0625", "--overwrite", "--quiet")
        self.assertTrue(self.same("out", "other"))
        before = fingerprint(self.path("out"))
        _, err = self.mesogen("branch", "out", "./other/../out", "--at", "0.0625", "--overwrite", code=2)
        self.assertIn("out is the run to branch from: choose another folder for the new run", err)
        self.assertEqual(fingerprint(self.path("out")), before)
        _, err = self.mesogen("branch", "nothing", "new", code=2)
        self.assertIn("nothing holds no run", err)


class BranchesOfARunThatGoesOn(CommandTest):
    """A run replaces its newest checkpoints; a branch starts from what it found."""

    def replace_when_opened(self, file, other):
        """Whoever opens `file` gets what it holds now; who opens it once more, what `other` holds."""
        holder = os.open(file, os.O_RDWR)
        opened = []

        def replace(*_):
            opened.append(file)
            os.replace(other, file)
            fcntl.fcntl(holder, fcntl.F_SETLEASE, fcntl.F_UNLCK)

        before = signal.signal(signal.SIGIO, replace)
        self.addCleanup(signal.signal, signal.SIGIO, before)
        self.addCleanup(os.close, holder)
        fcntl.fcntl(holder, fcntl.F_SETLEASE, fcntl.F_WRLCK)
        return opened

    def test_a_checkpoint_that_is_replaced_meanwhile(self):
        self.mesogen("run", self.write_case(), "--output", "out", "--quiet")
        newest, older = checkpoints.newest(self.path("out"))
        opened = self.replace_when_opened(newest, older)
        _, err = self.mesogen("branch", "out", "new", "--at", "0.1", "--set", "time.end=0.12")
        self.assertEqual(opened, [newest])
        self.assertIn(f"branching from out/{os.path.basename(newest)} at t = 0.1 s", err)
        with h5py.File(self.path("new", "results.h5"), "r") as file:
            self.assertEqual(file["parameters/branched_from"].attrs["time"], 0.1)
            self.assertEqual(list(file["particles/fluid/position/time"]), [0.1, 0.12])


if __name__ == "__main__":
    unittest.main()
