"""run, check, graph and field list: right cases, wrong cases, output folders."""

import os
import tomllib
import unittest

import h5py
import numpy
from support import CASE, PROJECT, CommandTest


def final(folder, field):
    with h5py.File(os.path.join(folder, "results.h5"), "r") as file:
        return numpy.asarray(file[f"particles/fluid/{field}/value"][-1])


class Runs(CommandTest):
    def test_run_leaves_results(self):
        out, err = self.mesogen("run", self.write_case(), "--output", "out")
        self.assertEqual(out, "")
        self.assertIn("256 particles", err)
        self.assertIn("100 %", err)
        with h5py.File(self.path("out", "results.h5"), "r") as file:
            self.assertAlmostEqual(file["particles/fluid/velocity/time"][-1], 0.1)
            self.assertEqual(file["particles/fluid/velocity/value"].shape[1:], (256, 2))
            self.assertEqual(len(file["observables/flow/v_rms/time"]), 3)
        self.assertTrue(os.path.exists(self.path("out", "results.xdmf")))

    def test_quiet_says_nothing(self):
        self.assertEqual(self.mesogen("run", self.write_case(), "--output", "out", "--quiet"), ("", ""))

    def test_threads_do_not_change_a_bit(self):
        case = self.write_case()
        for threads in ("1", "3"):
            self.mesogen("run", case, "--output", threads, "--threads", threads)
        for field in ("position", "velocity", "order_tensor"):
            self.assertTrue(numpy.array_equal(final(self.path("1"), field), final(self.path("3"), field)), field)

    def test_an_expression_is_kept_as_it_stands(self):
        push = '\n[physics.push]\ntype = "body_force"\nforce = ["0.1 * sin(2 * pi * y / Ly + t)", 0.0]\n'
        self.mesogen("run", self.write_case(CASE + push), "--output", "out", "--quiet",
                     "--set", "output.fields=['position', 'body_force']")
        with open(self.path("out", "case.toml"), "rb") as file:
            case = tomllib.load(file)
        self.assertEqual(case["physics"]["push"]["force"], ["0.1 * sin(2 * pi * y / Ly + t)", 0.0])
        edges = case["domain"]["size"]
        with h5py.File(self.path("out", "results.h5"), "r") as file:
            time = file["particles/fluid/body_force/time"][-1]
        y = final(self.path("out"), "position")[:, 1]
        force = final(self.path("out"), "body_force")
        numpy.testing.assert_allclose(force[:, 0], 0.1 * numpy.sin(2 * numpy.pi * y / edges[1] + time), atol=1e-12)
        numpy.testing.assert_array_equal(force[:, 1], 0.0)

    def test_default_folder_is_named_like_the_case(self):
        os.mkdir(self.path("study"))
        self.mesogen("run", self.write_case(name="study/case.toml"))
        self.assertTrue(os.path.exists(self.path("output", "study", "results.h5")))
        self.mesogen("run", self.write_case(name="study/coarse.toml"))
        self.assertTrue(os.path.exists(self.path("output", "coarse", "results.h5")))

    def test_set_changes_a_key(self):
        self.mesogen("run", self.write_case(), "--output", "out", "--set", "time.end=0.02", "--set",
                     "output.interval=0.02")
        with h5py.File(self.path("out", "results.h5"), "r") as file:
            self.assertAlmostEqual(file["particles/fluid/velocity/time"][-1], 0.02)

    def test_folder_that_holds_a_run_is_refused(self):
        case = self.write_case()
        self.mesogen("run", case, "--output", "out")
        before = os.stat(self.path("out", "results.h5")).st_mtime_ns
        _, err = self.mesogen("run", case, "--output", "out", code=2)
        self.assertIn("already holds a run", err)
        self.assertIn("--overwrite", err)
        self.assertEqual(os.stat(self.path("out", "results.h5")).st_mtime_ns, before)
        self.mesogen("run", case, "--output", "out", "--overwrite")
        self.assertGreater(os.stat(self.path("out", "results.h5")).st_mtime_ns, before)

    def test_case_is_not_replaced_by_its_run(self):
        case = self.write_case()
        os.symlink("case.toml", self.path("link.toml"))
        for given in ("case.toml", case, "link.toml"):
            for more in ([], ["--overwrite"]):
                self.assertEqual(self.mesogen("run", given, "-o", ".", *more, code=2),
                                 ("", "error: ./case.toml is the case to be run, and a run keeps its own case.toml "
                                      "there: choose another --output\n"))
        self.mesogen("run", case, "-o", "out")
        _, err = self.mesogen("run", "out/case.toml", "-o", "out", "--overwrite", code=2)
        self.assertIn("out/case.toml is the case to be run", err)
        self.assertTrue(os.path.exists(self.path("out", "results.h5")))
        self.write_case(CASE + "# other\n", "other.toml")
        _, err = self.mesogen("run", "other.toml", "-o", ".", "--overwrite", code=2)
        self.assertEqual(err, "error: ./case.toml was not stored by a run, and a run keeps its own case.toml there: "
                              "choose another --output, or move it away\n")
        with open(case, encoding="utf-8") as file:
            self.assertEqual(file.read(), CASE)

    def test_profile_names_the_passes(self):
        _, err = self.mesogen("run", self.write_case(), "--output", "out", "--profile")
        self.assertRegex(err, r"\d+\.\d+ % .* physics\.activity: ")

    def test_kernel_and_boundary_are_one_word(self):
        for kernel in ("quintic", "wendland_c2", "wendland_c4", "wendland_c6"):
            for boundary in ("periodic_ghosts", "periodic_wrap"):
                case = self.write_case(CASE.replace("quintic", kernel).replace("periodic_ghosts", boundary))
                self.mesogen("run", case, "--output", f"{kernel}-{boundary}", "--set", "time.end=0.02")


class WrongCases(CommandTest):
    def refused(self, text, *expected):
        _, err = self.mesogen("run", self.write_case(text), "--output", "out", code=2)
        for part in expected:
            self.assertIn(part, err)
        self.assertRegex(err, r"case\.toml:\d+")
        self.assertFalse(os.path.exists(self.path("out")), "something was written")

    def test_unknown_kernel(self):
        self.refused(CASE.replace('"quintic"', '"quintik"'), "kernel.type", 'did you mean "quintic"?')

    def test_feedback_without_a_filter(self):
        published = CASE.replace('"wcsph"', '"wcsph_published"')
        self.refused(published.replace("viscosity = 0.5", "viscosity = 0.5\ndensity_filter = 0.0\nfilter_feedback = true"),
                     "case.toml:18", "filter_feedback: needs a filter: set density_filter above 0, such as "
                     "density_filter = 1.0")

    def test_physics_without_its_group_is_told(self):
        _, err = self.mesogen("run", self.write_case(CASE.replace("[physics.activity]", "[activity]")), code=2)
        self.assertIn('activity: unknown section or key; did you mean "physics.activity"?', err)

    def test_what_is_refused_late_is_told_alone(self):
        published = CASE.replace('"wcsph"', '"wcsph_published"')
        _, err = self.mesogen("run", self.write_case(published.replace(
            "viscosity = 0.5", "viscosity = 0.5\ndensity_filter = 0.0\nfilter_feedback = true")), code=2)
        self.assertRegex(err, r"^error: \S*case\.toml:18:\d+: physics\.flow\.filter_feedback: .*\n$")

    def test_keys_of_the_published_scheme_are_named_with_its_plugin(self):
        self.refused(CASE.replace("viscosity = 0.5", "viscosity = 0.5\ndensity_filter = 1.0"), "case.toml:17",
                     'density_filter: belongs to the published scheme: write type = "wcsph_published"')

    def test_support_beyond_half_the_box(self):
        self.refused(CASE.replace("1.3333", "40.0"), "smoothing_length", "case.toml:9")

    def test_spacing_whose_numbers_overflow(self):
        single = 'precision = "single"'
        tiny = CASE.replace("[1.6, 1.6]", "[1.6e-9, 1.6e-9]").replace("spacing = 0.1", "spacing = 1e-10")
        huge = CASE.replace("[1.6, 1.6]", "[1.6e9, 1.6e9]").replace("spacing = 0.1", "spacing = 1e8")
        for text in (tiny, huge):
            text = text.replace('precision = "double"', single)
            self.refused(text, "case.toml:6:11: particles.spacing: is beyond what the kernel's numbers can be in single "
                               "precision: spacings go from 3.", ' m; take run.precision = "double", or another unit of length')
            self.mesogen("check", self.write_case(text.replace(single, 'precision = "double"')), "--quick")

    def test_too_few_neighbours(self):
        self.refused(CASE.replace("1.3333", "0.1"), "case.toml:9:20: kernel.smoothing_length: is 0.1 particle spacings, "
                     'which leaves a particle too few neighbours for second derivatives: the kernel "quintic" needs at least '
                     "0.54 here, where particles start in a lattice arrangement and move")
        self.mesogen("run", self.write_case(CASE.replace("1.3333", "0.54")), "--output", "out")

    def test_defect_at_a_periodic_face(self):
        defects = 'type = "defects"\ndefects = [[1.6, 0.4, 0.5], [0.8, 2.8, -0.5]]'
        text = CASE.replace('type = "modes"\nmodes = [[1, 0, 0.2, 0.3], [0, 1, 0.1, 1.1]]', defects)
        self.mesogen("run", self.write_case(text), "--output", "face")
        self.mesogen("run", self.write_case(text.replace("1.6, 0.4", "0.0, 0.4").replace("2.8", "1.2")), "--output", "inside")
        difference = final(self.path("face"), "order_tensor") - final(self.path("inside"), "order_tensor")
        self.assertLess(abs(difference).max(), 1e-9)
        self.refused(text.replace('"periodic_ghosts"', '{ type = "walls", axes = ["x", "y"] }'),
                     "director.defects: row 1: must lie in the box, x from 0 to 1.6 m, where this axis ends at walls, but is "
                     "at 1.6")

    def test_unknown_output_field(self):
        self.refused(CASE.replace("interval = 0.05\n[run]", 'interval = 0.05\nfields = ["velocitty"]\n[run]'),
                     "output.fields", "velocitty", "velocity")

    def test_all_errors_at_once(self):
        self.refused(CASE.replace("activity =", "activty =").replace("viscosity = 0.5", "viscosity = -0.5")
                     .replace('"quintic"', '"quintik"'), "activty", "viscosity", "quintik")

    def test_syntax_error(self):
        self.refused(CASE.replace("[time]", "[time"), "case.toml:26")

    def test_no_such_file(self):
        _, err = self.mesogen("run", "nothing.toml", code=2)
        self.assertIn("nothing.toml: cannot be read", err)

    def test_wrong_override(self):
        case = self.write_case()
        _, err = self.mesogen("check", case, "--set", "physics.flow.viscosty=1", code=2)
        self.assertIn("viscosty", err)
        _, err = self.mesogen("check", case, "--set", "time.end", code=2)
        self.assertIn("time.end", err)


class Looks(CommandTest):
    def test_graph_as_text_shows_order_and_pruning(self):
        out, _ = self.mesogen("graph", self.write_case())
        self.assertLess(out.index("physics.flow: "), out.index("physics.activity: "))
        self.assertIn("pruned: ", out)

    def test_graph_for_graphviz(self):
        out, _ = self.mesogen("graph", self.write_case(), "--dot")
        self.assertRegex(out, r"^digraph ")
        self.assertEqual(out.count("{"), out.count("}"))

    def test_field_list(self):
        out, _ = self.mesogen("field", "list", self.write_case())
        self.assertRegex(out, r"(?m)^velocity +vector +m/s +physics\.flow +predicted and corrected with acceleration$")
        self.assertRegex(out, r"(?m)^order_tensor +order tensor +1 +physics\.nematic +predicted and corrected with order_tensor_rate$")


if __name__ == "__main__":
    unittest.main()
