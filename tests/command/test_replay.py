"""replay: observers over the frames of a run."""

import os
import signal
import unittest

import h5py
import numpy
from support import CASE, CommandTest

OBSERVERS = """
[observers.flow]
type = "flow_statistics"
interval = 0.05
[observers.nematic]
type = "nematic_statistics"
interval = 0.05
[observers.defects]
type = "defects"
interval = 0.05
[observers.paths]
type = "pathlines"
count = 8
interval = 0.05
[observers.mixing]
type = "mixing"
interval = 0.05
"""
HEAD, REST = CASE.split("[observers.flow]")
RUN = (HEAD.replace("end = 0.1", "end = 0.5") + '[velocity]\ntype = "uniform"\nvalue = [2.0, -1.3]\n'
       + '[colour]\ntype = "quarter"\n' + OBSERVERS
       + '[output]\ninterval = 0.05\nfields = ["velocity", "order_tensor", "density"]\n[run]\nprecision = "double"\n')
# Made from stored fields by sums over neighbours, whose order in storage is another one.
ROUNDED = {("flow", "vorticity_rms"), ("flow", "divergence_rms"), ("flow", "volume_min"), ("flow", "volume_max"),
           ("mixing", "interface_length"), ("mixing", "stretching")}


def samples(file):
    """{(observer, quantity): (step, time, value)}"""
    with h5py.File(file, "r") as results:
        return {(observer, quantity): tuple(numpy.asarray(group[part]) for part in ("step", "time", "value"))
                for observer, quantities in results["observables"].items() for quantity, group in quantities.items()}


class Replay(CommandTest):
    def run_once(self, text=RUN, folder="out"):
        self.mesogen("run", self.write_case(text), "--output", folder, "--quiet")

    def refused(self, *arguments):
        _, err = self.mesogen("replay", *arguments, code=2)
        return err

    def test_frames_as_often_as_samples_give_the_numbers_of_the_run(self):
        self.run_once(RUN.replace('"density"]', '"density", "compression"]'))
        _, err = self.mesogen("replay", "out")
        self.assertIn("5 observers look at 11 frames, from t = 0 to 0.5 s; each observer samples all of them, whatever its interval", err)
        self.assertIn("observers.paths follows every step of a run; here it sees the frames alone, and goes straight from "
                      "one to the next", err)
        self.assertIn("samples are in out/replay.h5", err)
        self.assertNotIn("warning", err)
        before, after = samples(self.path("out", "results.h5")), samples(self.path("out", "replay.h5"))
        self.assertEqual(before.keys(), after.keys())
        for name, (step, at, value) in before.items():
            self.assertTrue(numpy.array_equal(step, after[name][0]), name)
            self.assertTrue(numpy.array_equal(at, after[name][1]), name)
            if name == ("paths", "distance"):
                self.assertTrue(numpy.all(after[name][2] <= value + 1e-12))
            elif name in ROUNDED or name[0] in ("nematic", "paths"):
                numpy.testing.assert_allclose(after[name][2], value, rtol=1e-9, atol=1e-12, err_msg=str(name))
            else:
                self.assertTrue(numpy.array_equal(after[name][2], value, equal_nan=True), name)
        crossed = numpy.abs(before["paths", "path"][2]).max()
        self.assertGreater(crossed, 1.6, "no particle left the box: the test shows nothing")

    def test_prescribed_values_are_made_anew(self):
        lit = RUN.replace("elastic_constant = 0.02", 'elastic_constant = "0.02 + 0.01 * sin(2 * pi * x / Lx + t)"')
        lit = lit.replace('"density"]', '"density", "compression"]')
        self.run_once(lit)
        _, err = self.mesogen("replay", "out")
        self.assertNotIn("warning", err)
        before, after = samples(self.path("out", "results.h5")), samples(self.path("out", "replay.h5"))
        name = ("nematic", "free_energy")
        self.assertGreater(numpy.ptp(before[name][2]), 1e-3)
        numpy.testing.assert_allclose(after[name][2], before[name][2], rtol=1e-9, err_msg=str(name))
        # By a field that no frame holds they cannot be.
        fed = lit.replace("sin(2 * pi * x / Lx + t)", "solute").replace(
            "[observers.flow]", '[physics.fuel]\ntype = "solute"\ndiffusivity = 0.01\nsource = 0.5\nlargest = 1.0\n'
            "[observers.flow]", 1)
        self.run_once(fed, "fed")
        _, err = self.mesogen("replay", "fed")
        self.assertIn("observers.nematic does without 'elastic_energy', made from 'solute', which the frames do not hold", err)
        self.assertTrue(numpy.isnan(samples(self.path("fed", "replay.h5"))[name][2]).all())

    def test_an_incompressible_flow_makes_its_gradients_anew(self):
        self.run_once(RUN.replace('type = "wcsph"', 'type = "incompressible"'))
        _, err = self.mesogen("replay", "out")
        self.assertNotIn("warning", err)
        before, after = samples(self.path("out", "results.h5")), samples(self.path("out", "replay.h5"))
        for name in (("flow", "v_rms"), ("flow", "vorticity_rms"), ("nematic", "free_energy"), ("nematic", "mean_order")):
            self.assertGreater(numpy.abs(before[name][2]).max(), 1e-3, name)
            numpy.testing.assert_allclose(after[name][2], before[name][2], rtol=1e-7, err_msg=str(name))

    def test_single_precision_agrees_to_its_rounding(self):
        self.run_once(RUN.replace('"double"', '"single"'))
        self.mesogen("replay", "out", "--quiet")
        before, after = samples(self.path("out", "results.h5")), samples(self.path("out", "replay.h5"))
        for name in (("flow", "v_rms"), ("flow", "vorticity_rms"), ("nematic", "mean_order"), ("paths", "path")):
            if name in before:
                numpy.testing.assert_allclose(after[name][2], before[name][2], rtol=1e-5, atol=1e-5, err_msg=str(name))
        self.assertIn(("flow", "v_rms"), before)

    def test_threads_do_not_change_a_bit(self):
        self.run_once()
        for threads in ("1", "3"):
            self.mesogen("replay", "out", "--threads", threads, "--output", threads + ".h5", "--quiet")
        one, three = samples(self.path("1.h5")), samples(self.path("3.h5"))
        for name, (_, _, value) in one.items():
            self.assertTrue(numpy.array_equal(value, three[name][2], equal_nan=True), name)

    def test_new_observers_on_an_old_run(self):
        self.run_once(CASE.replace("interval = 0.05\n[run]", 'interval = 0.05\nfields = ["velocity", "order_tensor"]\n'
                                   "[run]"))
        new = self.write_case('[observers.turning]\ntype = "defects"\n[observers.few]\ntype = "pathlines"\ncount = 3\n'
                              "[domain]\nsize = 7\n", name="new.toml")
        self.mesogen("replay", "out", new, "--set", "observers.few.count=2", "--output", "new.h5")
        found = samples(self.path("new.h5"))
        self.assertEqual({name[0] for name in found}, {"turning", "few"})
        self.assertEqual(found["few", "path"][2].shape, (3, 2, 2))
        with h5py.File(self.path("new.h5"), "r") as file:
            case = file["parameters/case"].asstr()[()]
        self.assertIn("[observers.few]", case)
        self.assertNotIn("flow_statistics", case)
        self.assertFalse(os.path.exists(self.path("out", "replay.h5")))

    def test_run_that_was_killed(self):
        case = self.write_case(RUN.replace("end = 0.5", "end = 500.0"))
        process = self.start("run", case, "--output", "out")
        self.wait_for(process, "out", "frames", "000002.h5")
        self.assertIn("another run is writing into out", self.refused("out"))
        process.send_signal(signal.SIGKILL)
        process.wait()
        self.mesogen("replay", "out")
        with h5py.File(self.path("out", "results.h5"), "r") as file:
            steps = numpy.asarray(file["particles/fluid/position/step"])
        self.assertTrue(numpy.array_equal(samples(self.path("out", "replay.h5"))["flow", "v_rms"][0], steps))
        os.remove(self.path("out", "frames", "000001.h5"))
        err = self.refused("out", "--overwrite")
        self.assertIn("cannot read the frame of step ", err)
        self.assertIn("frames/000001.h5: cannot open it as HDF5", err)

    def test_fields_that_the_frames_lack(self):
        self.run_once(RUN.replace('["velocity", "order_tensor", "density"]', '["velocity"]'))
        err = self.refused("out")
        self.assertIn("observers.nematic reads 'order_tensor', which the frames of out do not hold: run the case again with "
                      "'order_tensor' in output.fields, or leave this observer out", err)
        self.assertIn("observers.nematic reads 'order_tensor_gradient', made from 'order_tensor', which the frames", err)
        self.assertIn("observers.defects reads 'order_tensor', which", err)
        self.assertIn("warning: observers.flow does without 'density', which the frames do not hold", err)
        self.assertFalse(os.path.exists(self.path("out", "replay.h5")))

    def test_samples_that_are_there_already(self):
        self.run_once()
        self.mesogen("replay", "out", "--quiet")
        self.assertIn("out/replay.h5 is there already: replace it with --overwrite, or choose another --output",
                      self.refused("out"))
        self.mesogen("replay", "out", "--quiet", "--overwrite")

    def test_files_of_a_run_are_not_overwritten(self):
        self.run_once()
        os.mkdir(self.path("out", "frames"))  # as it is until the run is complete
        os.symlink("out/frames", self.path("link"))
        for file in ("out/results.h5", "out/mesogen.lock", "out/checkpoint_a.h5.tmp", "out/frames/000001.h5",
                     "out/frames/new.h5", "out/frames/../frames/000001.h5", "link/000001.h5"):
            self.assertIn(f"{file} belongs to a run: choose another --output",
                          self.refused("out", "--overwrite", "--output", file))
        os.makedirs(self.path("mine", "frames"))
        self.mesogen("replay", "out", "--output", "mine/frames/new.h5", "--quiet")

    def test_folder_of_the_output_that_is_not_there(self):
        self.run_once()
        err = self.refused("out", "--output", "sub/x.h5")
        self.assertEqual(err, "error: cannot write sub/x.h5: there is no folder sub; make it first, or choose another "
                              "--output\n")

    def test_only_observers_can_be_changed(self):
        self.run_once()
        self.assertIn("--set: physics.flow.viscosity: cannot be changed: only keys of observers can",
                      self.refused("out", "--set", "physics.flow.viscosity=2"))
        other = self.write_case("[observers.flow]\ntype = \"flow_statistics\"\nevrey = 3\n", name="other.toml")
        self.assertRegex(self.refused("out", other), r'other\.toml:3:\d+: observers\.flow\.evrey: .*every')

    def test_without_observers(self):
        self.run_once(HEAD + "[output]\ninterval = 0.05\n")
        self.assertIn("out/case.toml has no observers: name a case file that has some, mesogen replay DIR CASE, or add one "
                      "with --set observers.flow.type=flow_statistics", self.refused("out"))
        self.mesogen("replay", "out", "--set", "observers.flow.type=flow_statistics", "--quiet")
        empty = self.write_case("[domain]\n", name="empty.toml")
        self.assertIn("empty.toml:1:1: observers: must hold at least one table with a type, such as [observers.flow]; "
                      "nothing else of this file is used", self.refused("out", empty))

    def test_what_is_no_run(self):
        self.assertIn("nothing holds no run: it has no case.toml", self.refused("nothing"))
        os.mkdir(self.path("begun"))
        self.write_case(name="begun/case.toml")
        self.assertIn("cannot read begun/results.h5: ", self.refused("begun"))


if __name__ == "__main__":
    unittest.main()
