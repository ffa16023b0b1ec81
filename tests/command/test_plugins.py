"""plugin list and plugin info; plugins that are refused."""

import os
import shutil
import unittest

from support import BROKEN_PLUGINS, CASE, MESOGEN, PROJECT, CommandTest

BUILT = os.path.join(os.path.dirname(os.path.dirname(MESOGEN)), "lib", "mesogen", "plugins")


def plugins_of_the_project():
    """(kind, name) of every folder under plugins/."""
    root = os.path.join(PROJECT, "plugins")
    kinds = {"kernels": "kernel", "boundaries": "boundary", "physics": "physics", "observers": "observer"}
    return [(kinds[kind], name) for kind in kinds for name in sorted(os.listdir(os.path.join(root, kind)))]


class Plugins(CommandTest):
    def test_list_names_every_plugin_under_its_kind(self):
        out, err = self.mesogen("plugin", "list")
        self.assertEqual(err, "")
        kind, listed = None, []
        for line in out.splitlines():
            if not line.startswith(" "):
                kind = line
            else:
                listed.append((kind, line.split()[0]))
        self.assertEqual(sorted(listed), sorted(plugins_of_the_project()))

    def test_info_of_every_plugin_documents_every_parameter(self):
        for kind, name in plugins_of_the_project():
            out, _ = self.mesogen("plugin", "info", name)
            self.assertTrue(out.startswith(f"{kind} {name} "), out)
            self.assertIn(f"{name}.so (", out)
            self.assertRegex(out, r"(?m)^parameters")

    def test_info_shows_unit_range_and_default(self):
        out, _ = self.mesogen("plugin", "info", "wcsph")
        self.assertRegex(out, r"viscosity +number, in Pa s, > 0, required")
        self.assertRegex(out, r"adds to: .*acceleration")

    def test_info_of_an_unknown_plugin(self):
        _, err = self.mesogen("plugin", "info", "quintik", code=2)
        self.assertIn('no plugin is called "quintik"', err)
        self.assertIn('did you mean "quintic"?', err)

    def test_refused_plugin_is_told_and_the_others_still_work(self):
        out, err = self.mesogen("plugin", "list", "--plugin-path", os.path.join(BROKEN_PLUGINS, "wrong_abi"))
        self.assertIn("quintic", out)
        self.assertIn("warning: plugin refused: ", err)
        self.assertIn("wrong_abi.so: it was built for plugin interface 99", err)

    def test_info_of_a_refused_plugin(self):
        folder = os.path.join(BROKEN_PLUGINS, "wrong_tag")
        _, err = self.mesogen("plugin", "info", "wrong_tag", "--plugin-path", folder, code=3)
        self.assertIn('error: the plugin "wrong_tag" was refused: ', err)

    def test_case_that_needs_a_refused_plugin(self):
        case = self.write_case(CASE.replace('"quintic"', '"wrong_abi"'))
        folder = os.path.join(BROKEN_PLUGINS, "wrong_abi")
        _, err = self.mesogen("run", case, "--output", "out", "--quiet", "--plugin-path", folder, code=3)
        self.assertRegex(err, r'case\.toml:8:\d+: kernel\.type: the kernel plugin "wrong_abi" was refused')
        self.assertFalse(os.path.exists(self.path("out")))

    def test_two_plugins_of_one_name(self):
        shutil.copy(os.path.join(BUILT, "quintic.so"), self.path("my_quintic.so"))
        _, err = self.mesogen("plugin", "list", MESOGEN_PLUGIN_PATH=self.folder, code=3)
        self.assertIn('two plugins of the kind kernel are called "quintic"', err)
        self.assertIn("my_quintic.so", err)
        self.assertIn(os.path.join(BUILT, "quintic.so"), err)

    def test_plugin_path_that_is_no_folder(self):
        _, err = self.mesogen("plugin", "list", "--plugin-path", "nowhere", code=2)
        self.assertIn("plugin folder nowhere does not exist", err)

    def test_unknown_instruction_set(self):
        _, err = self.mesogen("plugin", "list", MESOGEN_SIMD="mmx", code=2)
        self.assertIn('MESOGEN_SIMD is "mmx"', err)

    def test_baseline_instruction_set(self):
        out, _ = self.mesogen("plugin", "info", "wcsph", MESOGEN_SIMD="baseline")
        self.assertIn("(baseline)", out)


if __name__ == "__main__":
    unittest.main()
