"""The report: what it writes, says and refuses."""

import contextlib
import io
import os
import subprocess
import sys
import unittest

import h5py
import matplotlib
import numpy as np
import synthetic
from matplotlib import image
from matplotlib.figure import Figure

import mesogen
from mesogen import report
from mesogen.figures import director, light, pathlines, series, style, vorticity
from mesogen.figures.scene import Scene

FILES = ["director.png", "vorticity.png", "pathlines.png", "mixing.png", "series.png", "summary.png"]


def call(*arguments):
    """Exit code, output and errors of the command."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = report.main(list(arguments))
    return code, out.getvalue(), err.getvalue()


class Pictures(synthetic.FolderTest):
    def test_writes_all_and_none_is_blank(self):
        synthetic.complete(self.folder)
        before = dict(matplotlib.rcParams)
        code, out, err = call(self.folder)
        self.assertEqual((code, err), (0, ""))
        self.assertEqual(out, "".join(f"wrote {self.folder}/report/{name}\n" for name in FILES))
        for name in FILES:
            pixels = image.imread(os.path.join(self.folder, "report", name))[..., :3]
            self.assertGreater(min(pixels.shape[:2]), 400, name)
            self.assertGreater((pixels < 0.9).any(axis=2).mean(), 0.01, name)
            self.assertGreater(len(np.unique((pixels[::4, ::4] * 20).astype(int).reshape(-1, 3), axis=0)), 20, name)
        self.assertEqual(dict(matplotlib.rcParams), before)

    def test_shows_the_edges_of_the_light(self):
        position = synthetic.lattice()
        for name, dark in (("half", 0.0), ("even", 0.3)):
            results = synthetic.Results(os.path.join(self.folder, name))
            results.field("position", "m", [position])
            results.field("activity", "Pa", [np.where(position[:, 0] < 0.5 * synthetic.BOX[0], 0.3, dark)])
            with mesogen.open(results.close()) as run:
                axes = Figure().subplots()
                light.draw(axes, Scene(run, -1))
                lines = [path.vertices for collection in axes.collections for path in collection.get_paths()]
            if name == "even":
                self.assertEqual(lines, [])
                continue
            # Half way of the box, and where it begins and ends.
            edges = {round(float(x), 1) for line in lines for x in line[:, 0]}
            self.assertTrue(edges <= {-0.0, 0.0, 0.5 * synthetic.BOX[0], float(synthetic.BOX[0])}, edges)
            self.assertIn(0.5 * synthetic.BOX[0], edges)

    def test_leaves_out_what_is_not_stored(self):
        results = synthetic.Results(self.folder)
        results.field("position", "m", [synthetic.lattice()])
        results.field("velocity", "m/s", [synthetic.waves(synthetic.lattice())[0]])
        code, out, _ = call(results.close())
        self.assertEqual(code, 0)
        self.assertIn("left out director.png: field order_tensor is not stored (see 'fields' in [output])\n", out)
        self.assertIn("left out pathlines.png: no observer recorded 'path'", out)
        self.assertIn("left out mixing.png: neither field 'colour' nor a mixing index", out)
        self.assertIn("left out series.png: no observer recorded a number over time\n", out)
        self.assertEqual(sorted(os.listdir(f"{self.folder}/report")), ["summary.png", "vorticity.png"])

    def test_series_before_the_first_frame(self):
        results = synthetic.Results(self.folder)
        results.observable("stream", "v_rms", "m/s", [0.0])
        code, out, _ = call(results.close())
        self.assertEqual(code, 0)
        self.assertIn("left out director.png: no frame of particles is stored yet", out)
        self.assertEqual(sorted(os.listdir(f"{self.folder}/report")), ["series.png", "summary.png"])

    def test_fluid_at_rest_in_uniform_order(self):
        results = synthetic.Results(self.folder)
        results.field("position", "m", [synthetic.lattice()])
        results.field("velocity", "m/s", [np.zeros((288, 2))])
        results.field("order_tensor", "1", [np.tile([1.0, 0.0], (288, 1))])
        code, out, _ = call(results.close())
        self.assertEqual(code, 0)
        self.assertIn("vorticity.png", out)

    def test_several_frames_are_chosen(self):
        synthetic.complete(self.folder)
        code, out, _ = call(self.folder, "--frames", "1:")
        self.assertEqual(code, 0)
        drawn = sorted(name for name in os.listdir(f"{self.folder}/report") if name.startswith("director"))
        self.assertEqual(drawn, ["director_000001.png", "director_000002.png"])
        # What no frame has is told once.
        self.assertEqual(len(set(out.splitlines())), len(out.splitlines()))
        for options, frames in ((("--every", "2"), (0, 2)), (("--frames", ":-2"), (0, 1)),
                                (("--frames=0:1", "--every", "3"), (0,))):
            target = os.path.join(self.folder, "-".join(options))
            self.assertEqual(call(self.folder, *options, "--output", target)[0], 0)
            self.assertEqual(sorted(name for name in os.listdir(target) if name.startswith("vorticity")),
                             [f"vorticity_{frame:06}.png" for frame in frames])

    def test_frames_that_are_not_there(self):
        synthetic.complete(self.folder)
        for options, text in ((("--frames", "1:7"), "no frame 7; "), (("--frames", "2:1"), "no frames from 2 to 1; ")):
            code, _, err = call(self.folder, *options)
            self.assertEqual(code, 2)
            self.assertTrue(err.startswith(f"error: {text}"), err)
        for options in (("--frames", "3"), ("--frames", "a:b"), ("--every", "0"), ("--frame", "1", "--frames", "0:1"),
                        ("--frame", "1", "--every", "2")):
            with self.assertRaises(SystemExit) as refused, contextlib.redirect_stderr(io.StringIO()):
                report.main([self.folder, *options])
            self.assertEqual(refused.exception.code, 2)

    def test_symbols_of_defects_leave_room_between_them(self):
        # Few: a share of the picture, wherever they stand. Many: a share of their mean distance. Both: of a narrow box.
        self.assertEqual(director.defect_size((8.0, 8.0), 2), 0.018 * 8.0)
        self.assertEqual(director.defect_size((8.0, 8.0), 20), 0.018 * 8.0)
        self.assertAlmostEqual(director.defect_size((8.0, 8.0), 400), 0.1 * 0.4)
        self.assertEqual(director.defect_size((100.0, 4.0), 2), 0.06 * 4.0)

    def test_frame_and_output_are_chosen(self):
        synthetic.complete(self.folder)
        target = os.path.join(self.folder, "elsewhere")
        code, out, _ = call(self.folder, "--frame", "0", "--output", target)
        self.assertEqual(code, 0)
        self.assertIn("left out pathlines.png: fewer than two samples of 'path' up to this frame", out)
        self.assertIn(f"wrote {target}/director.png", out)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "report")))


class Refusals(synthetic.FolderTest):
    def test_no_results(self):
        os.makedirs(self.folder)
        code, out, err = call(self.folder)
        self.assertEqual((code, out), (2, ""))
        self.assertIn(f"error: {self.folder}: holds no results.h5", err)
        self.assertEqual(os.listdir(self.folder), [])

    def test_no_such_frame(self):
        synthetic.complete(self.folder)
        code, _, err = call(self.folder, "--frame", "5")
        self.assertEqual(code, 2)
        self.assertIn("no frame 5", err)
        self.assertIn("holds 3 frames, 0 to 2", err)

    def test_as_a_module_without_a_display(self):
        package = os.path.dirname(os.path.dirname(os.path.abspath(report.__file__)))
        environment = {key: value for key, value in os.environ.items() if key != "DISPLAY"}
        environment.update(PYTHONPATH=package, MPLBACKEND="TkAgg")
        done = subprocess.run(
            [sys.executable, "-m", "mesogen.report", synthetic.complete(self.folder)],
            env=environment, capture_output=True, text=True, check=False,
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertTrue(os.path.exists(os.path.join(self.folder, "report", "summary.png")))


class Content(synthetic.FolderTest):
    def setUp(self):
        super().setUp()
        self.run_ = mesogen.open(synthetic.complete(self.folder))
        self.addCleanup(self.run_.close)

    def scene(self, frame):
        return Scene(self.run_, frame)

    def axes(self):
        return style.page(4, 3).add_subplot()

    def test_defects_are_those_recorded_at_the_frame(self):
        np.testing.assert_array_equal(self.scene(1).defects, [[2, 1, 0.5, 0.3], [7, 3, -0.5, -0.2]])
        self.assertEqual(len(self.scene(2).defects), 0)

    def test_defects_are_found_on_the_grid_when_none_were_recorded_then(self):
        self.run_.series_steps = lambda *_: np.array([5])
        self.assertEqual(self.scene(1).defects.shape, (0, 4))

    def test_axes_are_the_box_in_metres(self):
        scene, axes = self.scene(-1), self.axes()
        director.draw(axes, scene)
        self.assertEqual((axes.get_xlim(), axes.get_ylim()), ((0, 10), (0, 5)))
        self.assertEqual((axes.get_xlabel(), axes.get_ylabel()), ("x (m)", "y (m)"))
        self.assertEqual(axes.get_aspect(), 1)
        self.assertEqual(axes.get_title("right"), "t = 2 s")

    def test_vorticity_scale_is_symmetric(self):
        scene, axes = self.scene(-1), self.axes()
        vorticity.draw(axes, scene)
        low, high = axes.images[0].get_clim()
        self.assertEqual(low, -high)
        self.assertAlmostEqual(high, (2 * np.pi / 10) ** 2 + (2 * np.pi / 5) ** 2, delta=0.1)

    def test_defect_near_a_face_is_drawn_on_both_sides(self):
        scene, axes = self.scene(1), self.axes()
        scene.__dict__["defects"] = np.array([[0.1, 2.5, 0.5, np.pi]])
        director.draw_defects(axes, scene, 0.2)
        left = sorted(round(path.vertices[:, 0].max(), 3) for path in axes.collections[0].get_paths())
        self.assertEqual(len(left), 2)
        self.assertAlmostEqual(left[1] - left[0], 10.0)

    def test_panels_group_what_belongs_together(self):
        found = {panel.title: panel for panel in series.panels(self.scene(-1).run)}
        self.assertEqual([name for name, *_ in found["density"].lines], ["min", "max"])
        self.assertEqual([name for name, *_ in found["number of defects"].lines], ["+1/2", "−1/2"])
        self.assertEqual([name for name, *_ in found["total momentum"].lines], ["x", "y"])
        self.assertEqual(found["rms velocity"].unit, "m/s")
        self.assertEqual(
            set(found),
            {"density", "number of defects", "total charge", "total momentum", "rms velocity", "mixing index"},
        )


class Units(synthetic.FolderTest):
    def test_axes_have_the_units_of_the_case(self):
        synthetic.complete(self.folder)
        for units, x, time in (({}, "x (m)", "time (s)"), ({"length": "um", "time": "ms"}, "x (um)", "time (ms)")):
            with h5py.File(os.path.join(self.folder, "results.h5"), "r+") as stored:
                stored["particles/fluid/box/edges"].attrs["unit"] = units.get("length", "m")
                for name in ("position", "velocity", "order_tensor"):
                    stored[f"particles/fluid/{name}/time"].attrs["unit"] = units.get("time", "s")
            with mesogen.open(self.folder) as run:
                scene = Scene(run, -1)
                _, (axes,) = style.tiles(1, 1, (2, 2))
                vorticity.draw(axes, scene)
                self.assertEqual(axes.get_xlabel(), x)
                self.assertTrue(scene.time_text.endswith(units.get("time", "s")), scene.time_text)
                labels = [place.get_xlabel() for place in series.figure(scene).axes]
                self.assertIn(time, labels)


class Texts(unittest.TestCase):
    def test_units(self):
        self.assertEqual(style.unit_text("kg/m^3"), "kg/m³")
        self.assertEqual(style.unit_text("kg/(m3 s)"), "kg/(m³ s)")
        self.assertEqual(style.unit_text("1/s"), "s⁻¹")
        self.assertEqual(style.unit_text("m s^-12"), "m s⁻¹²")
        self.assertEqual(style.unit_text("1"), "")
        self.assertEqual(style.labelled("order", "1"), "order")
        self.assertEqual(style.labelled("rms divergence", "1/s", -3), "rms divergence (10⁻³ s⁻¹)")


class Paths(unittest.TestCase):
    box = np.array([10.0, 5.0])

    def test_inside_nothing_changes(self):
        path = np.array([[[1, 1], [2, 2]], [[1.5, 1], [2, 3]]], dtype=float)
        segments, sample = pathlines.wrapped_segments(path, self.box)
        np.testing.assert_array_equal(segments, [[[1, 1], [1.5, 1]], [[2, 2], [2, 3]]])
        np.testing.assert_array_equal(sample, [0, 0])

    def test_a_piece_over_a_face_is_drawn_on_both_sides_and_stays_short(self):
        path = np.array([[[9.5, 1]], [[10.5, 1]], [[21.0, -0.5]]])
        segments, sample = pathlines.wrapped_segments(path, self.box)
        np.testing.assert_allclose(segments[0], [[9.5, 1], [10.5, 1]])
        np.testing.assert_allclose(segments[1], [[0.5, 1], [11.0, -0.5]])
        np.testing.assert_allclose(segments[2], [[-0.5, 1], [0.5, 1]])
        np.testing.assert_allclose(segments[3], [[-9.5, 6], [1.0, 4.5]])
        np.testing.assert_array_equal(sample, [0, 1, 0, 1])

    def test_far_from_home(self):
        path = np.array([[[-25.5, 52.0]], [[-25.0, 53.0]]])
        segments, _ = pathlines.wrapped_segments(path, self.box)
        np.testing.assert_allclose(segments, [[[4.5, 2], [5.0, 3]]])

    def test_unknown_places_are_left_out(self):
        path = np.array([[[1, 1]], [[np.nan, np.nan]], [[2, 2]], [[3, 2]]], dtype=float)
        segments, sample = pathlines.wrapped_segments(path, self.box)
        np.testing.assert_array_equal(segments, [[[2, 2], [3, 2]]])
        np.testing.assert_array_equal(sample, [2])


if __name__ == "__main__":
    unittest.main()
