"""plugin check: what it says of plugins that are fit and of those that are not."""

import os
import re
import shutil
import unittest

from support import BROKEN_PLUGINS, MESOGEN, CommandTest

UNFIT = os.path.join(os.path.dirname(BROKEN_PLUGINS), "unfit_plugins")
PLUGINS = os.path.join(os.path.dirname(os.path.dirname(MESOGEN)), "lib", "mesogen", "plugins")


class PluginCheck(CommandTest):
    def check(self, kind, fault, code=1):
        """The checks of an unfit plugin that failed, as {what: problem}."""
        out, err = self.mesogen("plugin", "check", os.path.join(UNFIT, f"unfit_{kind}.so"), "--set", f"fault={fault}",
                                code=code)
        self.assertEqual(err, "")
        self.assertTrue(out.startswith(f"{kind} unfit_{kind} 1.0"), out)
        return dict(line[10:].split(": ", 1) for line in out.splitlines() if line.startswith("  FAILED"))

    def assert_fails(self, kind, fault, what, problem):
        """Exactly this check fails."""
        failed = self.check(kind, fault)
        self.assertEqual(list(failed), [what], failed)
        self.assertRegex(failed[what], problem)

    def test_a_fit_plugin(self):
        for kind in ("boundary", "initial", "physics", "observer"):
            self.assertEqual(self.check(kind, "none", code=0), {})
        out, err = self.mesogen("plugin", "check", "quintic")
        self.assertEqual(err, "")
        self.assertRegex(out, r"^kernel quintic 1\.0\.0: /.*quintic\.so\n(  ok      .*\n)+$")

    def test_what_is_not_checked_is_told(self):
        out, _ = self.mesogen("plugin", "check", "friction")
        self.assertRegex(out, r"  ok      CUDA agrees with the CPU\n|  note    not checked: that CUDA agrees with the CPU, "
                              r"because (this plugin has no library for CUDA|there is no CUDA device here)")

    def test_descriptor_and_parameters(self):
        failed = self.check("kernel", "none")
        self.assertEqual(failed, {
            "its descriptor has a version and a summary": 'its version is "1.0": make it three numbers, such as 1.0.0',
            "every parameter has a unit and a doc text, and no name twice":
                "'fault' has no doc text: add .doc(\"...\")",
            "every default is a value that a case may give":
                "the test's case:13:13: kernel.sharpness: must be > 0, but is -1.0"})

    def test_kernel(self):
        self.assertRegex(self.check("kernel", "rises")["its shape can be used"], "it is not positive at q = 0")
        failed = self.check("kernel", "narrow")
        what = "the volume of a particle on a lattice is the square of the spacing, to 5 %"
        self.assertRegex(failed[what], r"it is 0\.\d+ times that with h = 4/3 spacings: its support is too narrow")

    def test_a_kernel_without_an_unrolled_form(self):
        out, _ = self.mesogen("plugin", "check", os.path.join(UNFIT, "unfit_kernel.so"), code=1)
        self.assertIn("  note    pair loops take the general form of the kernel, which is slower; unrolled are", out)
        self.assertIn("unfit_kernel is not fit for use: 3 of its checks failed", out)

    def test_boundary(self):
        kept = "particles are kept inside, their paths unbroken"
        for fault, problem in (("lost", r"keep_inside brings the coordinate 1 m to 1 m|outside of \[0, 1\]"),
                               ("uncounted", r"counts 0 boxes: position \+ images \* box must stay the same"),
                               ("restless", "a particle inside the box must stay where it is")):
            self.assertRegex(self.check("boundary", fault)[kept], problem)
        faces = "sums over neighbours see no face on a lattice"
        missing = "neighbours in walls or beyond the faces are missing or are there twice"
        self.assert_fails("boundary", "missing", faces, missing)
        self.assert_fails("boundary", "twice", faces, missing)
        self.assert_fails("boundary", "rule", faces, "ghost_rule or wall_rule gives something else")
        self.assert_fails("boundary", "again", "the same input gives the same bits, again and with 3 threads",
                          "something is left over from another run, or not set before it is read")

    def test_physics(self):
        touch = "passes touch only what they declared, and make finite numbers"
        for fault, problem in (
                ("undeclared_read", 'pass "work" at step 0, t = 0 s: it reads the field \'velocity\', which it did not '
                                    "declare: name it in the pass's reads, reads_neighbours or reads_if_present"),
                ("undeclared_write", "writes the field 'density', which it did not declare"),
                ("optional", "writes the field 'colour', which it did not declare"),
                ("not_finite", "'unfit' of particle 17 is nan")):
            self.assertRegex(self.check("physics", fault)[touch], re.compile(problem))
        described = "fields and passes are named and described"
        for fault, problem in (("no_doc", "the field 'unfit' has no doc text or no unit"),
                               ("twins", "two passes are called 'work'"),
                               ("no_body", "the pass 'work' does nothing: give it a body with .run"),
                               ("idle", "the pass 'work' makes no field, so it never runs")):
            self.assertRegex(self.check("physics", fault)[described], problem)
        limits = "limits on the step are positive and named"
        self.assertIn('the limit on the step "nothing" is -1 s: it must be above 0',
                      self.check("physics", "limit")[limits])
        self.assert_fails("physics", "nameless", limits, "a limit has no name: say what limits, and by which rule")
        same = "the same input gives the same bits, again and with 3 threads"
        self.assertRegex(self.check("physics", "leftover")[same], "something is left over from another run")
        self.assert_fails("physics", "threads", same, r"\(with 3 threads\): let each particle write only what is its own")
        self.assert_fails("physics", "memory", "a resumed run goes on to the same bits as an unbroken one",
                          r"after a resume: name what passes bring from step to step, by keep\(\)")
        self.assert_fails("physics", "overflow", "single precision agrees with double",
                          "in single precision: a number is too large or too small for float")

        published = "what it publishes stays the same when it is asked again"
        self.assert_fails("physics", "adds_constant", published,
                          r"the constant 'unfit' is \d, then \d: publish\(\) is called twice, so set it, do not add")
        self.assert_fails("physics", "adds_stress", published,
                          r"the stress is \d, then \d: publish\(\) is called twice, so raise it by std::max")

    def test_physics_of_one_precision_alone(self):
        out, _ = self.mesogen("plugin", "check", os.path.join(BROKEN_PLUGINS, "exact", "exact.so"), code=1)
        self.assertIn("  FAILED  it can be made in single and double precision, in each of its dimensions: the physics "
                      'plugin "exact" has no form for 2 dimensions in single precision\n', out)

    def test_initial(self):
        described = "the fields that it sets are named and described"
        self.assert_fails("initial", "no_doc", described, "'heat' has no doc text or no unit")
        self.assertIn("it sets no field: name what it sets in plan()", self.check("initial", "nothing")[described])
        for fault, problem in (
                ("twins", "field 'heat' is set by [unfit_initial] twice"),
                ("derived", "[unfit_initial] sets 'heat_laplacian', which the framework makes: an initial condition sets "
                            "fields that a plugin introduces"),
                ("position", "[unfit_initial] sets 'position', which the framework makes"),
                ("not_finite", "plugin \"unfit_initial\", set(): component 0 of 'heat' is nan at particle 17: set a "
                               "finite number"),
                ("undeclared", "sets the field 'cold', which its plan() does not name"),
                ("component", "sets component 1 of 'heat', which has the components 0 to 0")):
            self.assertIn(problem, self.check("initial", fault)[described], fault)
        same = "the same input gives the same bits, again and with 3 threads"
        self.assert_fails("initial", "leftover", same, "take random numbers from mesogen/exec/random.hpp")
        self.assert_fails("initial", "threads", same, r"\(with 3 threads\): set each particle by itself")

    def test_observer(self):
        described = "its quantities are named and described"
        for fault, problem in (("no_doc", "'first' has no doc text or no unit"), ("twins", "'first' is planned twice"),
                               ("nothing", "it plans no quantity: name what it records in plan")):
            self.assertRegex(self.check("observer", fault)[described], problem)
        reads = "it reads only what it planned, and samples exactly the quantities that it planned"
        for fault, problem in (
                ("undeclared", r"sample\(\) at step 0, t = 0 s: it reads the field 'velocity', which it did not declare"),
                ("unplanned", "observer 'tested' sampled 'second', which it did not plan: name it in plan"),
                ("missing", "observer 'tested' planned 'first' and did not sample it: set"),
                ("rows", "observer 'tested' sampled 3 numbers of 'pair', which has rows of 2")):
            self.assertRegex(self.check("observer", fault)[reads], problem)
        same = "the same input gives the same bits, again and with 3 threads"
        self.assertRegex(self.check("observer", "leftover")[same], "something is left over from another run")
        self.assert_fails("observer", "threads", same, r"\(with 3 threads\): sum in one order")
        self.assert_fails("observer", "order", "it records the same however the particles are stored",
                          "with another order of storage: go by id")
        self.assert_fails("observer", "memory", "a resumed run records the same as an unbroken one",
                          r"after restore\(\): keep in save\(\) all that it has gathered since start\(\)")

    def test_values_that_others_give(self):
        out, err = self.mesogen("plugin", "check", "elastic_stress", code=2)
        self.assertEqual(out, "")
        self.assertEqual(err, "error: elastic_stress needs numbers that another plugin of a case would publish: add "
                              "--constant elastic_constant=VALUE --constant flow_alignment=VALUE\n")
        _, err = self.mesogen("plugin", "check", "elastic_stress", "--constant", "flow_alignment=0.7", code=2)
        self.assertIn("would publish: add --constant elastic_constant=VALUE\n", err)
        self.mesogen("plugin", "check", "elastic_stress", "--constant", "flow_alignment=0.7", "--constant",
                     "elastic_constant=0.02")

    def test_wrong_arguments(self):
        for arguments, message in (
                (["quintik"], 'no plugin is called "quintik" (see `mesogen plugin list`); did you mean "quintic"?; a '),
                (["nowhere/quintic.so"], "there is no plugin file nowhere/quintic.so"),
                (["friction", "--set", "coefficient"], "--set coefficient: must be KEY=VALUE"),
                (["friction", "--constant", "density=much"], "--constant density=much: much is no number"),
                (["friction", "--set", "coeficient=1.0"],
                 'error: --set: coeficient: unknown key; did you mean "coefficient"?\n'),
                (["friction", "--set", "coefficient=true"],
                 "error: --set: coefficient: must be a number, expression or image in "),
                (["friction", "--set", "type=wcsph"],
                 "error: --set: type: a key of the framework: only parameters of the plugin can be set here\n")):
            out, err = self.mesogen("plugin", "check", *arguments, code=2)
            self.assertIn(message, err)
            self.assertEqual(out, "")

    def test_of_two_values_the_last_is_taken(self):
        self.mesogen("plugin", "check", "friction", "--set", "coefficient=true", "--set", "coefficient=1.0")
        self.mesogen("plugin", "check", "friction", "--set", "coefficient=1.0", "--set", "coefficient=true", code=2)

    def test_the_file_goes_before_a_twin_that_is_installed(self):
        own = self.path("plug", "quintic.so")
        os.mkdir(self.path("plug"))
        shutil.copy(os.path.join(PLUGINS, "quintic.so"), own)
        out, _ = self.mesogen("plugin", "check", own)
        self.assertTrue(out.startswith(f"kernel quintic 1.0.0: {own}\n"), out)
        self.assertEqual(out.count("kernel quintic"), 1)

    def test_a_folder_whose_name_begins_alike(self):
        for folder in ("plug", "plug2"):
            os.mkdir(self.path(folder))
        shutil.copy(os.path.join(PLUGINS, "quintic.so"), self.path("plug2"))
        with open(self.path("plug", "quintic.so"), "w", encoding="utf-8") as file:
            file.write("no library")
        _, err = self.mesogen("plugin", "check", "plug/quintic.so", "--plugin-path", "plug2", code=3)
        self.assertIn("plug/quintic.so: it is not a shared library", err)

    def test_a_file_that_is_no_plugin(self):
        _, err = self.mesogen("plugin", "check", MESOGEN, code=2)
        self.assertIn(f"{MESOGEN} is no plugin: Mesogen loads libraries whose names end in .so", err)
        library = os.path.join(BROKEN_PLUGINS, "no_descriptor", "no_descriptor.so")
        _, err = self.mesogen("plugin", "check", library, code=3)
        self.assertIn("it exports no `mesogen_plugin`, so it is not a Mesogen plugin", err)

    def test_refused_plugin(self):
        folder = os.path.join(BROKEN_PLUGINS, "wrong_abi")
        for plugin in ("wrong_abi", os.path.join(folder, "wrong_abi.so")):
            _, err = self.mesogen("plugin", "check", plugin, "--plugin-path", folder, code=3)
            self.assertIn("it was built for plugin interface 99", err)


if __name__ == "__main__":
    unittest.main()
