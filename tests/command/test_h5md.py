"""What a run stores is H5MD 1.1, while it goes on, at its end, and of a replay."""

import os
import shutil
import signal
import sys
import unittest

import h5md
import h5py
import numpy
from support import CASE, PROJECT, CommandTest

sys.path.insert(0, os.path.join(PROJECT, "python"))
import mesogen  # noqa: E402

# Every observer and fields with units of all kinds.
ALL = CASE.replace("end = 0.1", "end = 0.2").split("[observers.flow]")[0] + """
[colour]
type = "quarter"
""" + "".join(f'[observers.{name}]\ntype = "{kind}"\ninterval = 0.05\n' for name, kind in {
    "flow": "flow_statistics", "nematic": "nematic_statistics", "defects": "defects", "paths": "pathlines",
    "mixing": "mixing", "spectrum": "energy_spectrum", "correlation": "correlation", "tracks": "defect_tracks",
}.items()) + """
[output]
interval = 0.05
fields = ["velocity", "order_tensor", "density", "velocity_gradient", "order_tensor_gradient", "order_tensor_laplacian",
          "volume", "density_gradient"]
[run]
precision = "single"
"""


def changed(file, edit):
    """What the rules say of the file after edit(h5py.File)."""
    copy = file + ".changed.h5"
    shutil.copyfile(file, copy)
    with h5py.File(copy, "r+") as root:
        edit(root)
    return h5md.problems(copy)


class H5md(CommandTest):
    def run_once(self, *more):
        self.mesogen("run", self.write_case(ALL), "--output", "out", "--quiet", *more)

    def test_a_finished_run_and_its_replay(self):
        self.run_once()
        self.assertEqual(h5md.problems(self.path("out", "results.h5")), [])
        self.mesogen("replay", "out")
        self.assertEqual(h5md.problems(self.path("out", "replay.h5")), [])

    def test_a_run_that_goes_on(self):
        case = self.write_case(ALL.replace("end = 0.2", "end = 1000.0"))
        process = self.start("run", case, "--output", "out", "--quiet")
        self.wait_for(process, "out", "frames", "000002.h5")
        os.kill(process.pid, signal.SIGKILL)
        process.wait()
        with h5py.File(self.path("out", "results.h5"), "r") as file:
            self.assertTrue(file["particles/fluid/velocity/value"].is_virtual)
        self.assertEqual(h5md.problems(self.path("out", "results.h5")), [])

    def test_walls(self):
        self.mesogen("run", os.path.join(PROJECT, "cases", "channel", "poiseuille.toml"), "--output", "out", "--quiet",
                     "--set", "time.end=0.002")
        self.assertEqual(h5md.problems(self.path("out", "results.h5")), [])
        with h5py.File(self.path("out", "results.h5"), "r") as file:
            self.assertEqual(list(file["particles/fluid/box"].attrs["boundary"]), [b"periodic", b"none"])

    def test_units_are_read_as_they_are_usually_written(self):
        self.run_once()
        units = {"particles/fluid/velocity": "m s-1", "particles/fluid/order_tensor": "1",
                 "particles/fluid/density": "kg m-3", "particles/fluid/order_tensor_laplacian": "m-2",
                 "observables/flow/v_rms": "m s-1"}
        with h5py.File(self.path("out", "results.h5"), "r") as file:
            for name, unit in units.items():
                self.assertEqual(file[name]["value"].attrs["unit"], unit.encode(), name)
            # Columns of different units have no unit of H5MD.
            self.assertNotIn("unit", file["observables/defects/defects/value"].attrs)
        with mesogen.open(self.path("out")) as run:
            self.assertEqual(run.unit("velocity"), "m/s")
            self.assertEqual(run.unit("order_tensor_laplacian"), "1/m2")
            self.assertEqual(run.series_unit("flow", "v_rms"), "m/s")
            self.assertEqual(run.series_unit("defects", "defects"), "m, m, 1, rad")
            self.assertEqual(run.periodic, (True, True))

    def test_the_rules_find_what_breaks_them(self):
        self.run_once()
        file = self.path("out", "results.h5")
        fluid, value = "particles/fluid", "particles/fluid/velocity/value"

        def variable(root):
            root["h5md/creator"].attrs["name"] = "Mesogen"

        def plain_unit(root):
            root[value].attrs["unit"] = numpy.bytes_(b"m/s")

        def no_module(root):
            del root["h5md/modules"]

        def enumerated(root):
            root[fluid + "/box"].attrs["boundary"] = numpy.array([1, 0])

        def own_times(root):
            times = root[fluid + "/image/time"][:]
            del root[fluid + "/image/time"]
            root[fluid + "/image/time"] = times

        def backwards(root):
            root["observables/flow/v_rms/step"][1] = 0

        for edit, text in ((variable, "/h5md/creator@name: must be a string of fixed length"),
                           (plain_unit, "'m/s' is no unit factor"), (no_module, "/h5md/modules: must be a group"),
                           (enumerated, "/particles/fluid/box@boundary: must be a string"),
                           (own_times, "/particles/fluid/image/time: must be a hard link"),
                           (backwards, "step must increase")):
            self.assertIn(text, "\n".join(changed(file, edit)), edit.__name__)


if __name__ == "__main__":
    unittest.main()
