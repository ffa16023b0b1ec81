"""Plugins that cannot be loaded, or break a promise once they are: exact words, exit codes, and nothing else harmed."""

import os
import re
import shutil
import unittest

import h5py
from support import BROKEN_PLUGINS, CASE, MESOGEN, CommandTest

BUILT = os.path.join(os.path.dirname(os.path.dirname(MESOGEN)), "lib", "mesogen", "plugins")
REFUSED = {
    "wrong_abi": r"it was built for plugin interface 99, this Mesogen has \d+; build it again",
    "wrong_size": r"its descriptor has 8 bytes, this Mesogen expects \d+; build it again",
    "wrong_tag": r"it was built with icc-7, this Mesogen with (gcc|clang)-itanium\d+-cxx11abi\d; build it again with the "
                 r"same compiler",
    "wrong_magic": r"what it exports as `mesogen_plugin` is not a plugin descriptor",
    "null_descriptor": r"what it exports as `mesogen_plugin` is not a plugin descriptor",
    "no_descriptor": r"it exports no `mesogen_plugin`, so it is not a Mesogen plugin",
    "unresolved": r"the dynamic linker refuses it: .*undefined symbol: function_that_nobody_wrote",
    "no_library": r"it is not a shared library",
    "empty": r"it is not a shared library",
    "null_name": r'its name "" is not made of small letters, digits and underscores',
    "null_version": r"its descriptor lacks a version, a summary or a factory",
    "null_summary": r"its descriptor lacks a version, a summary or a factory",
}
SCENE = CASE.replace("[output]", '[physics.bad]\ntype = "{name}"\n{keys}\n[output]').replace("{ A", "{{ A").replace(
    "0.5 }", "0.5 }}").replace("[time]", '[time]\nstepping = "explicit"')
PLACE = r"case\.toml:\d+:\d+: physics\.bad: "


class Refused(CommandTest):
    """Files that are no plugins, or no plugins for this Mesogen."""

    def refused(self, name, folder, reason):
        out, err = self.mesogen("plugin", "list", "--plugin-path", folder)
        self.assertRegex(err, rf"^warning: plugin refused: \S*/{name}\.so: {reason}\n$")
        for other in ("quintic", "periodic_ghosts", "wcsph", "defects"):
            self.assertRegex(out, rf"(?m)^  {other} ", "a plugin without fault is missing")
        # The scene does not need it: it runs.
        self.mesogen("run", self.write_case(), "--output", name, "--quiet", "--set", "time.end=0.01", "--plugin-path",
                     folder)
        _, err = self.mesogen("plugin", "info", name, "--plugin-path", folder, code=3)
        self.assertRegex(err, rf'\nerror: the plugin "{name}" was refused: \S*/{name}\.so: {reason}\n$')
        case = self.write_case(SCENE.format(name=name, keys=""))
        _, err = self.mesogen("check", case, "--plugin-path", folder, code=3)
        self.assertRegex(err, rf'(?m)case\.toml:\d+:\d+: physics\.bad\.type: the physics plugin "{name}" was refused: '
                              rf"\S*/{name}\.so: {reason}$")

    def test_every_one(self):
        for name, reason in REFUSED.items():
            with self.subTest(name):
                self.refused(name, os.path.join(BROKEN_PLUGINS, name), reason)

    def test_libraries_cut_short(self):
        os.mkdir(self.path("cut"))
        whole = os.path.join(BUILT, "friction.so")
        for left in (100, os.path.getsize(whole) // 2, os.path.getsize(whole) - 1):
            with self.subTest(left):
                shutil.copy(whole, self.path("cut", "cut.so"))
                os.truncate(self.path("cut", "cut.so"), left)
                _, err = self.mesogen("plugin", "list", "--plugin-path", "cut")
                self.assertRegex(err, r"cut\.so: it is cut short; build or copy it again\n$")

    def test_plugin_without_a_form_for_the_scene(self):
        case = self.write_case(CASE.replace("periodic_ghosts", "no_form"))
        _, err = self.mesogen("run", case, "--plugin-path", os.path.join(BROKEN_PLUGINS, "no_form"), code=2)
        self.assertRegex(err, r'case\.toml:\d+:\d+: domain\.boundary: the boundary plugin "no_form" has no form for 2 '
                              r"dimensions in double precision\n$")
        self.assertFalse(os.path.exists(self.path("output")))


class Misbehaving(CommandTest):
    """Plugins that load, and then throw, or do what they did not declare."""

    def told(self, code, *arguments, name="misbehaving", keys="", fields="[]", folder=None):
        case = self.write_case(SCENE.format(name=name, keys=keys).replace("[output]", f"[output]\nfields = {fields}"))
        folder = os.path.join(BROKEN_PLUGINS, folder or name)
        out, err = self.mesogen(*(arguments or ("check",)), case, "--plugin-path", folder, code=code)
        self.assertEqual(out, "")
        return err

    def test_constructor_parameters_and_keys(self):
        expected = {
            "constructor_throws": ("physics.bad.type", 'plugin "constructor_throws", constructor failed: nobody expects '
                                                       "this"),
            "parameters_throw": ("physics.bad", 'plugin "parameters_throw", parameters() failed: it threw something that '
                                                "is no std::exception"),
            "declared_twice": ("physics.bad", 'plugin "declared_twice", parameters(): declares the parameter "misdeed" '
                                              "twice"),
            "declared_as_table": ("physics.bad", 'plugin "declared_as_table", parameters(): declares the parameters '
                                                 '"misdeed" and "misdeed.of", of which one is a table that holds the '
                                                 "other"),
        }
        for name, (key, text) in expected.items():
            with self.subTest(name):
                self.assertRegex(self.told(3, name=name),
                                 rf"^error: \S*case\.toml:\d+:\d+: {re.escape(key)}: {re.escape(text)}\n$")
                folder = os.path.join(BROKEN_PLUGINS, name)
                _, err = self.mesogen("plugin", "info", name, "--plugin-path", folder, code=3)
                self.assertEqual(err, f"error: {text}\n")
                # What describes all plugins leaves it out, and says so.
                for verb in ("schema", "reference"):
                    out, err = self.mesogen(verb, "--plugin-path", folder)
                    self.assertRegex(err, rf"^warning: left out: \S*/{name}\.so: {re.escape(text)}\n$")
                    self.assertNotIn(name, out)
                out, _ = self.mesogen("plugin", "list", "--plugin-path", folder)
                self.assertRegex(out, rf"(?m)^  {name} ")

    def test_kernel_without_pieces(self):
        case = self.write_case(CASE.replace("quintic", "no_pieces"))
        folder = os.path.join(BROKEN_PLUGINS, "no_pieces")
        for verb in ("check", "run"):
            _, err = self.mesogen(verb, case, "--plugin-path", folder, code=2)
            self.assertRegex(err, r"^error: \S*case\.toml:\d+:\d+: kernel\.type: this kernel cannot be used: it has no "
                                  r"pieces\n$")

    def test_boundaries(self):
        expected = {
            # Asked by the first that looks where a particle has left the box: observers, who see particles inside.
            "keep_inside": (1, 'observers.flow (plugin "flow_statistics"), sample() at step 16, t = 0.05 s: plugin '
                               '"keep_inside", keep_inside() failed: nobody expects this'),
            "shear_not_finite": (3, 'plugin "shear_not_finite", shear(): moves an image of the box by (inf, 0, 0) m'),
            "shear_across": (3, 'plugin "shear_across", shear(): moves an image of the box along y, where the box is not '
                                "periodic"),
            "wall_particles": (3, 'plugin "wall_particles", wall_particles() failed: it threw something that is no '
                                  "std::exception"),
            "wall_astray": (3, 'plugin "wall_astray", wall_particles(): wall particle 0 at (3.2, -0.01, 0) m lies outside '
                               "the box along x, where the box is periodic: give the one inside, its images are made "
                               "from it"),
            "wall_nowhere": (3, 'plugin "wall_nowhere", wall_particles(): wall particle 0 is at (nan, -0.01, 0) m'),
            "mirror_astray": (3, 'plugin "mirror_astray", wall_particles(): the mirror point of wall particle 0, (0.25, '
                                 "1e+300, 0) m, lies outside the box: there is no fluid to take values from"),
            "long_normal": (3, 'plugin "long_normal", wall_particles(): the normal of wall particle 0, (0, 2, 0), is no '
                               "unit vector"),
            "normal_inward": (3, 'plugin "normal_inward", wall_particles(): the normal of wall particle 0, (0, -1, 0), '
                                 "does not point from the particle to its mirror point"),
            "normal_along": (3, 'plugin "normal_along", wall_particles(): the normal of wall particle 0, (1, 0, 0), does '
                                "not point from the particle to its mirror point"),
            "ghost_rule": (1, 'plugin "ghost_rule", ghost_rule() failed: no such image'),
            # Found while the case is put together, when the distortion of the director at the walls is looked for.
            "wall_rule": (2, 'plugin "wall_rule", wall_rule() failed: no such field'),
            "rule_of_another": (3, 'plugin "rule_of_another", wall_rule(): the rule for a field of rank order tensor has '
                                   "9 components instead of 2: make it with AffineRule(field)"),
            "rule_not_finite": (3, 'plugin "rule_not_finite", wall_rule(): component 0 of the rule for a field of rank '
                                   "order tensor is not finite"),
        }
        for name, (code, text) in expected.items():
            with self.subTest(name):
                case = self.write_case(CASE.replace("periodic_ghosts", name))
                moving = ["--set", "velocity.type=uniform", "--set", "velocity.value=[1.0, 0.0]", "--set",
                          "time.stepping=explicit"]
                _, err = self.mesogen("run", case, "--output", name, "--plugin-path",
                                      os.path.join(BROKEN_PLUGINS, "boundaries"),
                                      *(moving if name == "keep_inside" else []), code=code)
                place = r"(\S*case\.toml:4:12: domain\.boundary: )?"
                self.assertRegex(err, rf"(?m)^error: {place}{re.escape(text)}$")

    def test_key_of_the_framework(self):
        case = self.write_case(CASE.replace("[output]", '[observers.bad]\ntype = "reserved_key"\nmisdeed = ""\n[output]'))
        folder = os.path.join(BROKEN_PLUGINS, "reserved_key")
        _, err = self.mesogen("check", case, "--plugin-path", folder, code=3)
        self.assertRegex(err, r'^error: \S*case\.toml:\d+:\d+: observers\.bad: plugin "reserved_key" declares the '
                              r'parameter "interval", a key that the framework reads itself: give it another name\n$')

    def test_what_it_says_while_the_case_is_put_together(self):
        place = PLACE + 'plugin "misbehaving", '
        expected = {
            "publish throws": (3, place + r'publish\(\) failed: cannot do "publish throws"'),
            "declare throws": (3, place + r'declare\(\) failed: cannot do "declare throws"'),
            "declare throws an Error": (2, place + r"declare\(\): take another misdeed"),
            "cycle": (2, r"case\.toml: these passes wait for each other:\n    'physics\.bad: good from bad' needs 'bad' "
                         r"of 'physics\.bad: bad from good'\n    'physics\.bad: bad from good' needs 'good' of "
                         r"'physics\.bad: good from bad'\n  Remove one of the plugins from the case"),
            "two writers": (2, r"case\.toml: field 'good' has two writers: 'physics\.bad: first' and 'physics\.bad: "
                               r"second'\. Remove one of them from the case, or let both accumulate"),
            "reads what nobody has": (2, r"case\.toml: 'physics\.bad: work' reads 'unheard_of', which no plugin of this "
                                         r"case introduces\. Add one that does \(`mesogen plugin info` tells\), or "
                                         r"remove 'physics\.bad'"),
            "reads what nobody writes": (2, r"case\.toml: nobody in this case provides the field\n    'bad', wanted by "
                                            r"'physics\.bad: work'\n    'acceleration', wanted by the time integration"
                                            r"\n  Add a physics plugin that writes it \(`mesogen plugin list`\), or "
                                            r"remove what needs it"),
        }
        for misdeed, (code, text) in expected.items():
            with self.subTest(misdeed):
                keys = f'misdeed = "{misdeed}"'
                err = self.told(code, "run", keys=keys, fields='["good"]' if misdeed == "cycle" else "[]")
                self.assertRegex(err, rf"^error: \S*{text}\n$")
        self.assertFalse(os.path.exists(self.path("output")))

    def test_info_tells_what_it_can(self):
        folder = os.path.join(BROKEN_PLUGINS, "misbehaving")
        out, err = self.mesogen("plugin", "info", "misbehaving", "--plugin-path", folder)
        self.assertEqual(err, "")
        self.assertIn('\nthe rest depends on the case: plugin "misbehaving", declare() failed: cannot do ""\n', out)
        self.assertRegex(out, r"(?m)^  misdeed +text, required$")
        self.assertIn("\nobserver misbehaving 1.0.0: ", out)


class InARun(CommandTest):
    """Faults while the case runs: the frames before them stay."""

    def run_fails(self, code, misdeed, text, more=""):
        case = self.write_case(SCENE.format(name="misbehaving", keys=f'misdeed = "{misdeed}"\nafter = 0.06\n{more}'))
        _, err = self.mesogen("run", case, "--output", "out", "--overwrite", "--plugin-path",
                              os.path.join(BROKEN_PLUGINS, "misbehaving"), code=code)
        self.assertRegex(err, rf"(?m)^error: {text}$")
        self.assertNotIn("terminate", err)
        with h5py.File(self.path("out", "results.h5"), "r") as file:
            times = file["particles/fluid/velocity/time"][()]
            self.assertEqual(len(times), 2)
            self.assertTrue(times[0] == 0.0 and 0.05 <= times[1] < 0.06, times)
            self.assertEqual(file["particles/fluid/velocity/value"][1].shape, (256, 2))
            self.assertGreaterEqual(len(file["observables/flow/v_rms/value"]), 2)

    def test_what_a_pass_throws(self):
        where = r'physics\.bad \(plugin "misbehaving"\), pass "work" at step \d+, t = 0\.06\d* s'
        expected = {
            "pass throws": (1, " failed: cannot do \"pass throws\""),
            "pass throws an Error": (1, ": the film has dried out"),
            "pass throws a number": (1, " failed: it threw something that is no std::exception"),
            "particle throws": (1, " failed: particle 3 is bad"),
            "reads undeclared": (3, ": it reads the field 'density', which it did not declare: name it in the pass's reads, "
                                    "reads_neighbours or reads_if_present"),
            "writes undeclared": (3, ": it writes the field 'velocity', which it did not declare: name it in the pass's "
                                     "writes or accumulates"),
            "reads in another precision": (3, ": it asks for the field 'velocity' in another precision: take that of its "
                                              "class, Real"),
            "neighbours in another precision": (3, ": it asks for neighbours of another precision or dimension: take "
                                                   "those of its class, Real and Dim"),
        }
        for misdeed, (code, text) in expected.items():
            with self.subTest(misdeed):
                self.run_fails(code, misdeed, where + re.escape(text))

    def test_what_a_watch_throws(self):
        self.run_fails(1, "watch throws", r'physics\.bad \(plugin "misbehaving"\), watch of "clock" at step \d+, '
                                          r't = 0\.06\d* s failed: cannot do "watch throws"')

    def test_memory_is_no_fault_of_the_plugin(self):
        self.run_fails(1, "pass needs too much memory", "there is not enough memory; take fewer particles, or single "
                                                        "precision")

    def test_single_precision_plugin_asks_for_double(self):
        case = self.write_case(SCENE.format(name="misbehaving", keys='misdeed = "reads in another precision"')
                               .replace('"double"', '"single"'))
        _, err = self.mesogen("run", case, "--output", "out", "--plugin-path",
                              os.path.join(BROKEN_PLUGINS, "misbehaving"), code=3)
        self.assertIn("asks for the field 'velocity' in another precision", err)

    def observer_fails(self, code, misdeed, text):
        case = self.write_case(CASE.replace("[output]", f'[observers.bad]\ntype = "misbehaving"\nmisdeed = "{misdeed}"\n'
                                                        "every = 1\n[output]"))
        _, err = self.mesogen("run", case, "--output", "out", "--overwrite", "--plugin-path",
                              os.path.join(BROKEN_PLUGINS, "misbehaving"), code=code)
        self.assertRegex(err, rf"(?m)^error: {text}$")

    def test_observers(self):
        where = r'observers\.bad \(plugin "misbehaving"\), '
        self.observer_fails(3, "plan throws", r'\S*case\.toml:\d+:\d+: observers\.bad: plugin "misbehaving", plan\(\) '
                                              "failed: no plan")
        self.assertFalse(os.path.exists(self.path("out")))
        self.observer_fails(3, "reads undeclared", where + r"sample\(\) at step 0, t = 0 s: it reads the field 'density', "
                                                           r"which it did not declare: name it in plan\(\)")
        self.observer_fails(1, "follow throws", where + r"follow\(\) at step 1, t = \S+ s failed: lost")
        self.observer_fails(1, "sample throws", where + r"sample\(\) at step 2, t = \S+ s failed: it threw something that "
                                                        "is no std::exception")
        with h5py.File(self.path("out", "results.h5"), "r") as file:
            self.assertEqual(list(file["observables/bad/nothing/step"][()]), [0, 1])


if __name__ == "__main__":
    unittest.main()
