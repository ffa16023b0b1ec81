"""Reading results."""

import os
import unittest

import h5py
import numpy as np
import synthetic

import mesogen
from mesogen.units import plain


class Reading(synthetic.FolderTest):
    def setUp(self):
        super().setUp()
        self.run_ = mesogen.open(synthetic.complete(self.folder))
        self.addCleanup(self.run_.close)

    def test_lists_what_is_there(self):
        self.assertEqual(self.run_.fields, ["colour", "order_tensor", "position", "velocity"])
        self.assertEqual(list(self.run_.observers), ["blend", "knots", "stream", "tracers"])
        self.assertEqual(self.run_.observers["tracers"], ["distance", "path"])
        np.testing.assert_array_equal(self.run_.times, synthetic.TIMES)
        np.testing.assert_array_equal(self.run_.steps, synthetic.STEPS)
        np.testing.assert_array_equal(self.run_.box, synthetic.BOX)
        self.assertEqual(self.run_.count, 288)
        np.testing.assert_array_equal(self.run_.id, np.arange(288))

    def test_fields_by_frame(self):
        half = 0.5 * synthetic.waves(synthetic.lattice())[0]
        np.testing.assert_array_equal(self.run_.field("velocity", 1), half.astype("f4"))
        np.testing.assert_array_equal(self.run_["velocity"], (2 * half).astype("f4"))
        np.testing.assert_array_equal(self.run_.field("velocity", -3), 0 * half)
        self.assertEqual(self.run_["colour"].shape, (288,))
        self.assertEqual(self.run_["colour"].sum(), 72)
        self.assertEqual(self.run_.unit("velocity"), "m/s")
        self.assertIn("velocity", self.run_)
        self.assertNotIn("pressure", self.run_)
        self.assertEqual(self.run_.frame_at(1.2), 1)

    def test_director(self):
        angle, order = self.run_.director(2)
        np.testing.assert_allclose(angle, synthetic.order_tensor(synthetic.lattice(), 2)[1], atol=1e-14)
        np.testing.assert_allclose(order, 0.9, rtol=1e-14)

    def test_the_file_may_be_open_elsewhere_in_the_process(self):
        # HDF5 refuses a second opening with other locks: "file locking flag values don't match".
        with h5py.File(self.run_.file, "r") as second:
            self.assertIn("particles", second)
        for locking in (True, False):
            with h5py.File(os.path.join(self.folder, f"other_{locking}.h5"), "w") as file:
                file.create_group("observables")
            with h5py.File(os.path.join(self.folder, f"other_{locking}.h5"), "r", locking=locking):
                mesogen.open(os.path.join(self.folder, f"other_{locking}.h5")).close()

    def test_units(self):
        for stored, usual in {"m s-1": "m/s", "s-1": "1/s", "m+2 s-1": "m2/s", "kg m-3 s-1": "kg/(m3 s)", "1": "1",
                              "Pa-1 s-1": "1/(Pa s)", "m": "m", "m/s": "m/s", "kg/m^3": "kg/m^3",
                              "m, m, 1, rad": "m, m, 1, rad", "particle spacings": "particle spacings", "": ""}.items():
            self.assertEqual(plain(stored), usual)

    def test_series_and_tables(self):
        time, value = self.run_.series("stream", "v_rms")
        np.testing.assert_array_equal(time, synthetic.TIMES)
        np.testing.assert_array_equal(value, [0, 0.1, 0.2])
        self.assertEqual(self.run_.series("knots", "defects")[1].shape, (3, 2, 4))
        self.assertEqual(self.run_.table("knots", "defects", 0).shape, (0, 4))
        np.testing.assert_array_equal(self.run_.table("knots", "defects", 1)[1], [7, 3, -0.5, -0.2])
        self.assertEqual(self.run_.table("tracers", "path").shape, (2, 2))
        self.assertEqual(self.run_.observer_of("count_plus", "defects"), "knots")
        self.assertIsNone(self.run_.observer_of("count_plus", "v_rms"))

    def test_case(self):
        self.assertEqual(self.run_.case, synthetic.CASE)
        self.assertEqual(self.run_.title, "Made up")
        self.assertEqual(self.run_.parameters["physics"]["activity"]["activity"], 0.05)
        self.assertEqual(self.run_.version, "0.1.0")

    def test_says_what_it_is(self):
        self.assertEqual(repr(self.run_), f"<mesogen.Run {self.folder!r}: 288 particles, 3 frames to t = 2 s; fields "
                         "colour, order_tensor, position, velocity; observers blend, knots, stream, tracers>")
        self.run_.close()
        self.assertIn("closed", repr(self.run_))

    def test_names_that_are_not_there(self):
        with self.assertRaises(mesogen.NoSuchName) as error:
            self.run_.field("velocitty")
        self.assert_text(error, "no field 'velocitty'", "colour, order_tensor, position, velocity", "[output]")
        with self.assertRaises(mesogen.NoSuchName) as error:
            self.run_.series("flow", "v_rms")
        self.assert_text(error, "no observer 'flow'", "there are: blend, knots, stream, tracers")
        with self.assertRaises(mesogen.NoSuchName) as error:
            self.run_.series("blend", "v_rms")
        self.assert_text(error, "no quantity 'v_rms' in observer 'blend'", "there are: mixing_index")
        with self.assertRaises(mesogen.NoSuchName) as error:
            self.run_.field("velocity", 3)
        self.assert_text(error, "no frame 3", "holds 3 frames, 0 to 2")
        with self.assertRaises(mesogen.NoSuchName) as error:
            self.run_.table("knots", "defects", 7)
        self.assert_text(error, "no sample 7 of 'defects'", "holds 3")
        with self.assertRaises(mesogen.MesogenError) as error:
            self.run_.table("stream", "v_rms")
        self.assert_text(error, "'v_rms' of observer 'stream' is no table; use series()")

    def test_opens_the_file_too(self):
        with mesogen.open(self.run_.file) as run:
            self.assertEqual(run.folder, self.folder)


class RunInProgress(synthetic.FolderTest):
    """While a run goes on, results.h5 holds views of frames in files beside it."""

    def test_reads_frames_of_other_files_from_any_folder(self):
        results = synthetic.Results(self.folder)
        os.makedirs(os.path.join(self.folder, "frames"))
        layout = h5py.VirtualLayout(shape=(3, 4, 2), dtype="f8")
        for frame in range(3):
            name = f"frames/{frame:06}.h5"
            with h5py.File(os.path.join(self.folder, name), "w") as file:
                file["velocity"] = np.full((4, 2), float(frame))
            layout[frame] = h5py.VirtualSource(name, "velocity", shape=(4, 2))
        element = results.file.create_group("particles/fluid/velocity")
        element["step"], element["time"] = synthetic.STEPS, synthetic.TIMES
        element.create_virtual_dataset("value", layout, fillvalue=np.nan)
        results.close()
        here = os.getcwd()
        self.addCleanup(os.chdir, here)
        os.chdir("/")
        with mesogen.open(self.folder) as run:
            np.testing.assert_array_equal(run.field("velocity", 2), np.full((4, 2), 2.0))

    def test_no_frame_yet(self):
        results = synthetic.Results(self.folder)
        results.observable("stream", "v_rms", "m/s", [0.0])
        with mesogen.open(results.close()) as run:
            self.assertEqual(len(run.times), 0)
            self.assertEqual(run.count, 288)
            self.assertEqual(repr(run), f"<mesogen.Run {self.folder!r}: 288 particles, no frames; observers stream>")
            with self.assertRaises(mesogen.NoSuchName) as error:
                run.frame_at(1.0)
            self.assert_text(error, "holds 0 frames")
            with self.assertRaises(mesogen.NoSuchName) as error:
                run["velocity"]
            self.assert_text(error, "it holds no field at all")


class Replayed(synthetic.FolderTest):
    def test_a_file_of_samples_alone(self):
        """`mesogen replay` writes samples, the box and the ids, but no frames, to replay.h5 beside results.h5."""
        synthetic.complete(self.folder)
        results = synthetic.Results(self.folder, "replay.h5")
        results.observable("stream", "v_rms", "um ms-1", [0.0, 0.1])
        results.file["observables/stream/v_rms/time"].attrs["unit"] = "ms"
        results.close()
        with mesogen.open(results.path) as run:
            self.assertEqual((run.count, run.time_unit, run.fields), (288, "ms", []))
            self.assertEqual(repr(run), f"<mesogen.Run {results.path!r}: 288 particles, no frames; observers stream>")
            np.testing.assert_array_equal(run.id, np.arange(288))

    def test_ids_of_each_frame(self):
        results = synthetic.Results(self.folder)
        del results.file["particles/fluid/id"]
        results.field("id", "1", [[3, 5, 8]] * 2)
        with mesogen.open(results.close()) as run:
            np.testing.assert_array_equal(run.id, [3, 5, 8])
            self.assertEqual(run.count, 3)


class NothingToRead(synthetic.FolderTest):
    def refused(self, path, *parts):
        with self.assertRaises(mesogen.NoResults) as error:
            mesogen.open(path)
        self.assert_text(error, str(path), *parts)

    def test_no_folder(self):
        self.refused(self.folder, "no such folder")

    def test_folder_without_results(self):
        os.makedirs(self.folder)
        self.refused(self.folder, "holds no results.h5", "mesogen run --output")

    def test_not_hdf5(self):
        os.makedirs(self.folder)
        with open(os.path.join(self.folder, "results.h5"), "w", encoding="utf-8") as file:
            file.write("not HDF5")
        self.refused(self.folder, "cannot be read as HDF5")

    def test_other_hdf5(self):
        os.makedirs(self.folder)
        with h5py.File(os.path.join(self.folder, "results.h5"), "w") as file:
            file["something"] = 1
        self.refused(self.folder, "not the results of a Mesogen run")


class Cost(synthetic.FolderTest):
    def test_of_a_finished_run(self):
        results = synthetic.Results(self.folder)
        group = results.file.create_group("parameters/cost")
        for name, value in (("steps", 7), ("sessions", 1), ("wall_seconds", 1.5), ("cpu_seconds", 2.5), ("threads", 2),
                            ("peak_memory", 3_000_000_000)):
            group.attrs[name] = value
        with mesogen.open(results.close()) as run:
            self.assertEqual(run.cost, (7, 1, 1.5, 2.5, 2, 3_000_000_000))

    def test_before_the_end(self):
        with mesogen.open(synthetic.Results(self.folder).close()) as run:
            self.assertIsNone(run.cost)


class BranchedFrom(synthetic.FolderTest):
    def test_of_a_branch(self):
        results = synthetic.Results(self.folder)
        group = results.file.create_group("parameters/branched_from")
        for name, value in (("folder", "/runs/a"), ("checkpoint", "checkpoint_a.h5"), ("time", 1.5), ("step", 30),
                            ("changes", "time.end=2.0\ntitle=other")):
            group.attrs[name] = value
        with mesogen.open(results.close()) as run:
            self.assertEqual(run.branched_from,
                             ("/runs/a", "checkpoint_a.h5", 1.5, 30, ["time.end=2.0", "title=other"]))

    def test_of_another_run(self):
        with mesogen.open(synthetic.Results(self.folder).close()) as run:
            self.assertIsNone(run.branched_from)


if __name__ == "__main__":
    unittest.main()
