"""schema and reference: what the declarations say of a case."""

import glob
import json
import os
import resource
import subprocess
import tomllib
import unittest

import jsonschema
from support import BROKEN_PLUGINS, CASE, MESOGEN, PROJECT, CommandTest

BAD_CASES = os.path.join(PROJECT, "tests", "fixtures", "bad_cases")

# Bad cases that a schema can see, and where it sees them. Their plugins are made up for the tests of the reader; here
# real ones stand for them.
SEEN = {
    "bad_instance_name": "observers", "boundary_of_wrong_type": "domain.boundary", "empty_type": "kernel.type",
    "date": "particles.seed", "idle_keys": "time", "instance_is_no_table": "physics.speed",
    "missing_boundary": "domain", "missing_key": "time", "missing_sections": "",
    "missing_type": "physics.flow", "misspelt_key": "physics.activity", "misspelt_section": "", "no_physics": "",
    "one_dimension": "domain.size", "out_of_range": "physics.flow.viscosity", "section_expected": "time",
    "short_mode": "director.modes.0", "table_expected": "physics.nematic.bulk", "three_dimensions": "domain.size",
    "unknown_key": "physics.flow", "unknown_key_in_table": "physics.nematic.bulk", "unknown_top_level_key": "",
    "word_of_choice": "director.type", "wrong_type": "domain.size",
    "zero_spacing": "particles.spacing", "zero_step": "time.step",
}
STANDS_FOR = {"flow": "wcsph", "activity": "active_stress", "nematic": "beris_edwards", "statistics": "flow_statistics"}
MISSING_KEYS = {"beris_edwards": {"rotational_diffusivity": 0.4, "flow_alignment": 0.7}}


def with_real_plugins(case):
    for group in ("physics", "observers"):
        tables = case.get(group)
        for table in tables.values() if isinstance(tables, dict) else ():
            if isinstance(table, dict) and table.get("type") in STANDS_FOR:
                table["type"] = STANDS_FOR[table["type"]]
                table.update(MISSING_KEYS.get(table["type"], {}))
    return case


class Schema(CommandTest):
    def setUp(self):
        super().setUp()
        out, err = self.mesogen("schema")
        self.assertEqual(err, "")
        schema = json.loads(out)
        self.assertEqual(schema["$schema"], "http://json-schema.org/draft-07/schema#")
        jsonschema.Draft7Validator.check_schema(schema)
        self.schema = schema
        self.validator = jsonschema.Draft7Validator(schema)

    def errors(self, case):
        return {".".join(map(str, error.path)): error.message for error in self.validator.iter_errors(case)}

    def errors_of_text(self, text):
        return self.errors(tomllib.loads(text))

    def test_every_case_of_the_project_is_valid(self):
        cases = [*glob.glob(os.path.join(PROJECT, "cases", "*", "*.toml")),
                 *glob.glob(os.path.join(PROJECT, "cases", "*", "*", "case.toml"))]
        self.assertTrue(cases)
        for file in cases:
            with open(file, "rb") as stream:
                self.assertEqual(self.errors(tomllib.load(stream)), {}, file)

    def test_complete_cases_as_runs_store_them_are_valid(self):
        case = self.write_case()
        self.mesogen("run", case, "--output", "out", "--quiet", "--set", "time.end=0.01")
        with open(self.path("out", "case.toml"), "rb") as stream:
            self.assertEqual(self.errors(tomllib.load(stream)), {})

    def test_bad_cases_are_refused_where_they_are_bad(self):
        for name, place in SEEN.items():
            with open(os.path.join(BAD_CASES, name + ".toml"), "rb") as stream:
                errors = self.errors(with_real_plugins(tomllib.load(stream)))
            self.assertIn(place, errors, name)

    def test_errors_are_exact(self):
        self.assertEqual(self.errors_of_text(CASE), {})
        self.assertEqual(self.errors_of_text(CASE.replace("viscosity =", "viscosty =").replace("end = 0.1", "end = 0")),
                         {"physics.flow": "Additional properties are not allowed ('viscosty' was unexpected)",
                          "time.end": "0 is less than or equal to the minimum of 0.0"})

    def test_boundary_is_a_name_or_a_table(self):
        table = CASE.replace('boundary = "periodic_ghosts"', 'boundary = { type = "periodic_ghosts" }')
        self.assertEqual(self.errors_of_text(table), {})
        self.assertEqual(list(self.errors_of_text(table.replace("periodic_ghosts", "periodik"))), ["domain.boundary"])

    def test_keys_follow_the_type(self):
        modes = 'type = "modes"\nmodes = [[1, 0, 0.2, 0.3], [0, 1, 0.1, 1.1]]'
        self.assertEqual(self.errors_of_text(CASE.replace(modes, 'type = "perturbed"\namplitude = 0.1')), {})
        self.assertEqual(self.errors_of_text(CASE.replace(modes, 'type = "perturbed"')),
                         {"director": "'amplitude' is a required property"})
        jitter = CASE.replace("spacing = 0.1", "spacing = 0.1\njitter = 0.3")
        self.assertEqual(list(self.errors_of_text(jitter)), ["particles"])
        self.assertEqual(self.errors_of_text(jitter.replace("jitter", 'arrangement = "jittered"\njitter', 1)), {})
        self.assertEqual(self.errors_of_text(CASE.replace("end = 0.1", 'end = 0.1\nfactor = 0.5\nstep = "auto"')), {})
        self.assertEqual(list(self.errors_of_text(CASE.replace("end = 0.1", "end = 0.1\nfactor = 0.5\nstep = 0.1"))),
                         ["time"])

    def test_a_number_that_varies_is_a_text_or_an_image(self):
        def errors(value):
            return list(self.errors_of_text(CASE + f'\n[physics.push]\ntype = "body_force"\nforce = {value}\n'))

        image = '{ image = ["a.png", "b.png"], times = [0.0, 1.0], low = 0.0, high = 0.1 }'
        self.assertEqual(errors(f'["0.1 * x", {image}]'), [])
        self.assertEqual(errors('[0.1, { image = "a.png", low = 0.0, high = 0.1 }]'), [])
        self.assertEqual(errors('[0.1, { image = "a.png", low = 0.0 }]'), ["physics.push.force.1"])
        self.assertEqual(errors('[0.1, true]'), ["physics.push.force.1"])
        self.assertEqual(list(self.errors_of_text(CASE.replace("viscosity = ", 'viscosity = "2 * x" # '))),
                         ["physics.flow.viscosity"])

    def test_an_observer_has_one_timing(self):
        timing = '"flow_statistics"\ninterval = 0.05'
        self.assertEqual(self.errors_of_text(CASE.replace(timing, '"flow_statistics"\nevery = 3')), {})
        self.assertEqual(list(self.errors_of_text(CASE.replace(timing, timing + "\nevery = 3"))), ["observers.flow"])

    def test_keys_carry_unit_meaning_and_default(self):
        flow = self.schema["definitions"]["physics.wcsph"]["properties"]
        self.assertEqual(flow["viscosity"]["description"], "mu: dynamic viscosity, in Pa s")
        self.assertEqual(flow["shift"]["default"], 0.3)
        self.assertEqual(flow["type"]["description"][:24], "Weakly compressible flow")
        self.assertNotIn("default", self.schema["properties"]["output"]["properties"]["interval"])

    def test_plugins_of_other_folders_are_in_it(self):
        out, _ = self.mesogen("schema", "--plugin-path", os.path.join(BROKEN_PLUGINS, "twin_a"))
        self.assertIn("twin", json.loads(out)["properties"]["kernel"]["properties"]["type"]["enum"])
        self.assertNotIn("twin", self.schema["properties"]["kernel"]["properties"]["type"]["enum"])

    def test_file(self):
        self.assertEqual(self.mesogen("schema", "-o", "case.schema.json"), ("", ""))
        with open(self.path("case.schema.json"), encoding="utf-8") as file:
            self.assertEqual(json.load(file), self.schema)
        _, err = self.mesogen("schema", "-o", "nowhere/case.schema.json", code=2)
        self.assertIn("error: cannot write nowhere/case.schema.json: there is no folder nowhere; make it first, or choose "
                      "another --output\n", err)

    def test_file_that_is_there_already(self):
        for verb in ("schema", "reference"):
            case = self.write_case()
            _, err = self.mesogen(verb, "-o", case, code=2)
            self.assertIn("case.toml is there already: replace it with --overwrite, or choose another --output\n", err)
            with open(case, encoding="utf-8") as file:
                self.assertEqual(file.read(), CASE)
            self.mesogen(verb, "-o", case, "--overwrite")
            with open(case, encoding="utf-8") as file:
                self.assertEqual(file.read(), self.mesogen(verb)[0])
        _, err = self.mesogen("schema", "-o", ".", "--overwrite", code=2)
        self.assertIn("error: . is a folder: name a file in it with --output\n", err)

    def test_full_disk(self):
        # A limit on the size of files gives the same answer as a full disk.
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (1000, resource.RLIM_INFINITY))

        done = subprocess.run([MESOGEN, "schema", "-o", "case.schema.json"], cwd=self.folder, env=self.environment(),
                              text=True, capture_output=True, preexec_fn=limit, check=False)
        self.assertEqual((done.returncode, done.stderr),
                         (1, "error: cannot write case.schema.json: File too large; make room and try again, or choose "
                             "another place with --output\n"))
        self.assertEqual(os.listdir(self.folder), [])


class Reference(CommandTest):
    def test_committed_page_is_what_the_command_prints(self):
        out, err = self.mesogen("reference")
        self.assertEqual(err, "")
        with open(os.path.join(PROJECT, "docs", "reference.md"), encoding="utf-8") as file:
            committed = file.read()
        self.assertTrue(out == committed, "docs/reference.md is out of date; renew it: build/release/bin/mesogen "
                                          "reference -o docs/reference.md --overwrite")

    def test_page_names_no_files_of_this_machine(self):
        out, _ = self.mesogen("reference")
        self.assertNotIn(PROJECT, out)
        self.assertNotIn(".so", out)
        self.assertEqual(out, self.mesogen("reference", MESOGEN_SIMD="baseline")[0])

    def test_page_tells_of_keys_and_plugins(self):
        out, _ = self.mesogen("reference", "--plugin-path", os.path.join(BROKEN_PLUGINS, "twin_a"))
        for line in ("### director 1.0.0",
                     '| `amplitude` | number | rad | >= 0 | required | largest random deviation of the angle; only with '
                     '`type = "perturbed"` |',
                     "| `interval` | number | s | > 0 | | simulated time between stored frames; by default the whole run. "
                     "Steps are shortened to end exactly at these times, so another interval changes the steps, and "
                     "with them the rounding |",
                     "| `viscosity` | number | Pa s | > 0 | required | mu: dynamic viscosity |",
                     "| `order_tensor_rate` | order tensor | 1/s | DQ/Dt | |",
                     "| `v_rms` | one number | m/s | root of the mean square velocity, sqrt(<u.u>) |",
                     "### twin 1.0.0"):
            self.assertIn("\n" + line + "\n", out)


if __name__ == "__main__":
    unittest.main()
