"""plugin list and plugin info; plugins that are refused."""

import glob
import json
import os
import re
import shutil
import unittest

from support import BROKEN_PLUGINS, CASE, MESOGEN, PROJECT, CommandTest

BUILT = os.path.join(os.path.dirname(os.path.dirname(MESOGEN)), "lib", "mesogen", "plugins")


def plugins_of_the_project():
    """(kind, name) of every plugin that a folder under plugins/ builds."""
    found = []
    for file in sorted(glob.glob(os.path.join(PROJECT, "plugins", "*", "*", "CMakeLists.txt"))):
        with open(file, encoding="utf-8") as text:
            found += [(kind, name) for name, kind in re.findall(r"NAME (\w+) KIND (\w+)", text.read())]
    return found


class Plugins(CommandTest):
    def test_list_names_every_plugin_under_its_kind(self):
        out, err = self.mesogen("plugin", "list")
        self.assertEqual(err, "")
        kind, listed = None, []
        for line in out.splitlines():
            if not line.startswith(" "):
                kind = line
            elif not line.endswith(".so"):
                listed.append((kind, line.split()[0]))
        self.assertEqual(sorted(listed), sorted(plugins_of_the_project()))

    def test_list_names_the_file_of_every_plugin(self):
        out, _ = self.mesogen("plugin", "list", MESOGEN_SIMD="baseline")
        for _, name in plugins_of_the_project():
            self.assertRegex(out, rf"(?m)^  {name} .*\n +{re.escape(os.path.join(BUILT, name))}\.so$")

    def test_list_names_files_below_the_current_folder_from_there(self):
        os.mkdir(self.path("mine"))
        shutil.copy(os.path.join(BROKEN_PLUGINS, "twin_a", "first_twin.so"), self.path("mine"))
        out, _ = self.mesogen("plugin", "list", "--plugin-path", "mine")
        self.assertRegex(out, r"(?m)^  twin +1\.0\.0 +Cubic spline\n +mine/first_twin\.so$")

    def test_list_for_programs(self):
        out, err = self.mesogen("plugin", "list", "--json", "--plugin-path", os.path.join(BROKEN_PLUGINS, "wrong_abi"))
        self.assertEqual(err, "")
        told = json.loads(out)
        self.assertEqual(sorted((plugin["kind"], plugin["name"]) for plugin in told["plugins"]),
                         sorted(plugins_of_the_project()))
        for plugin in told["plugins"]:
            self.assertTrue(os.path.isabs(plugin["file"]) and os.path.exists(plugin["file"]), plugin)
            self.assertIn(plugin["instruction_set"], ("baseline", "x86-64-v3", "x86-64-v4"))
        self.assertEqual([os.path.basename(refused["file"]) for refused in told["refused"]], ["wrong_abi.so"])
        self.assertIn("plugin interface 99", told["refused"][0]["reason"])

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
        self.assertRegex(out, r"(?m)^plugin interface: \d+, built with (gcc|clang)-itanium")
        self.assertIn("publishes the constants: density, sound_speed, viscosity\n", out)
        self.assertIn("moves particles with: velocity, shift_velocity", out)

    def test_info_of_an_observer_tells_what_it_records(self):
        out, _ = self.mesogen("plugin", "info", "defects")
        self.assertIn("\nreads: order_tensor\n", out)
        self.assertRegex(out, r"(?m)^  defects +a changing number of rows of 4 numbers, in m, m, 1, rad$")
        out, _ = self.mesogen("plugin", "info", "pathlines")
        self.assertIn("\nlooks after every step\n", out)

    def info(self, name):
        out, err = self.mesogen("plugin", "info", name, "--json")
        self.assertEqual(err, "")
        plugins = json.loads(out)["plugins"]
        self.assertEqual([plugin["name"] for plugin in plugins], [name])
        return plugins[0]

    def test_info_for_programs_of_every_plugin(self):
        for kind, name in plugins_of_the_project():
            told = self.info(name)
            self.assertEqual(told["kind"], kind)
            self.assertRegex(told["version"], r"^\d+\.\d+\.\d+$")
            self.assertTrue(told["file"].endswith(f"{name}.so"))
            self.assertRegex(told["build_tag"], r"^(gcc|clang)-itanium\d+-cxx11abi\d$")
            self.assertGreaterEqual(told["abi"], 1)
            self.assertNotIn("not_described", told)
            for parameter in told["parameters"]:
                self.assertTrue(parameter["meaning"], f"{name}: {parameter['name']} has no meaning")
                self.assertNotEqual("default" in parameter, parameter["required"], parameter)

    def test_info_for_programs_of_physics(self):
        told = self.info("wcsph")
        viscosity = next(parameter for parameter in told["parameters"] if parameter["name"] == "viscosity")
        self.assertEqual(viscosity, {"name": "viscosity", "type": "number", "unit": "Pa s", "range": "> 0",
                                     "required": True, "meaning": "mu: dynamic viscosity",
                                     "schema": {"description": "mu: dynamic viscosity, in Pa s", "type": "number",
                                                "exclusiveMinimum": 0.0}})
        shift = next(parameter for parameter in told["parameters"] if parameter["name"] == "shift")
        self.assertEqual((shift["default"], shift["schema"]["maximum"]), (0.3, 10.0))
        velocity = next(field for field in told["fields"] if field["name"] == "velocity")
        self.assertEqual(velocity, {"name": "velocity", "rank": "vector", "unit": "m/s", "meaning": "u",
                                    "advanced": "predicted and corrected", "rate": "acceleration"})
        first = told["passes"][0]
        self.assertEqual(first, {"name": "continuity", "phase": "rates", "reads": ["compression", "velocity_gradient"],
                                 "reads_neighbours": [], "reads_if_present": [],
                                 "writes": ["compression_midpoint", "density"], "accumulates": ["compression_rate"]})
        self.assertEqual(told["constants"], ["density", "sound_speed", "viscosity"])
        self.assertEqual(told["moves_particles"], {"velocity": "velocity", "shift": "shift_velocity"})

    def test_info_for_programs_of_an_observer_and_a_kernel(self):
        told = self.info("defects")
        self.assertEqual((told["reads"], told["reads_if_present"], told["every_step"]), (["order_tensor"], [], False))
        table = told["quantities"][-1]
        self.assertEqual((table["name"], table["unit"], table["columns"], table["varying"]),
                         ("defects", "m, m, 1, rad", 4, True))
        self.assertEqual(self.info("quintic")["shape"]["support"], 3.0)

    def test_info_tells_the_dimensions(self):
        # What a plugin does not limit is limited by those that Mesogen is built for.
        unlimited = r" \(it has a form for any that Mesogen is built for\)"
        for name, words in (("friction", unlimited), ("beris_edwards", ""), ("quintic", unlimited), ("defects", "")):
            out, _ = self.mesogen("plugin", "info", name)
            self.assertRegex(out, f"(?m)^dimensions: 2{words}$")
            self.assertEqual(self.info(name)["dimensions"], [2])

    def test_plugin_of_a_dimension_that_is_not_built(self):
        folder = os.path.join(BROKEN_PLUGINS, "solid")
        out, _ = self.mesogen("plugin", "list", "--json", "--plugin-path", folder)
        dimensions = {plugin["name"]: plugin["dimensions"] for plugin in json.loads(out)["plugins"]}
        self.assertEqual((dimensions["solid_physics"], dimensions["friction"]), ([], [2]))
        refusal = ('the physics plugin "solid_physics" has no form for 2 dimensions: it has one for 3; a scene has as '
                   "many dimensions as domain.size has numbers")
        for verb in (("plugin", "info"), ("plugin", "check")):
            _, err = self.mesogen(*verb, "solid_physics", "--plugin-path", folder, code=2)
            self.assertIn(refusal, err)
        case = self.write_case(CASE + '[physics.solid]\ntype = "solid_physics"\n')
        _, err = self.mesogen("check", case, "--plugin-path", folder, code=2)
        self.assertRegex(err, r"case\.toml:\d+:8: physics\.solid\.type: " + re.escape(refusal))

    def test_info_of_an_unknown_plugin(self):
        _, err = self.mesogen("plugin", "info", "quintik", code=2)
        self.assertIn('no plugin is called "quintik"', err)
        self.assertIn('did you mean "quintic"?; a plugin of your own is found with --plugin-path DIR', err)

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

    def test_a_run_tells_that_its_sums_could_be_faster(self):
        out, _ = self.mesogen("plugin", "info", "wcsph")
        best = out.split("wcsph.so (")[1].split(")")[0]
        if best == "baseline" or os.environ.get("SANITIZED"):
            self.skipTest("this processor or build has one instruction set alone")
        case = self.write_case(CASE)
        _, err = self.mesogen("run", case, "--output", "fast")
        self.assertNotIn("sums over neighbours", err)
        # The dynamic linker then takes the library of the baseline.
        _, err = self.mesogen("run", case, "--output", "slow", GLIBC_TUNABLES="glibc.cpu.hwcaps=-AVX2,-AVX512F")
        self.assertRegex(err, r"warning: sums over neighbours run in code for baseline, but this processor has "
                              r"(x86-64-v[34]): they would be faster if Mesogen were built on this machine, or with "
                              r"-DMESOGEN_INSTRUCTION_SETS=\1\n")

    def test_baseline_instruction_set(self):
        out, _ = self.mesogen("plugin", "info", "wcsph", MESOGEN_SIMD="baseline")
        self.assertIn("(baseline)", out)


if __name__ == "__main__":
    unittest.main()
