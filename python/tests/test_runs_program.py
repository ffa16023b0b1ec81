"""Which finished runs still count for a program."""

import json
import os
import unittest

import synthetic

from mesogen.errors import StudyError
from mesogen.runs.program import Program, _defaults, _used, of_same_defaults

SCHEMA = {"properties": {"time": {"properties": {"factor": {"default": 1.0}, "default": {"type": "text"}}}},
          "definitions": {"physics.wcsph": {"properties": {"shift": {"default": 0.3}}},
                          "observer.new": {"properties": {"count": {"anyOf": [{"default": 16}]}}}}}


class Versions(unittest.TestCase):
    def test_a_program_that_is_not_there(self):
        with self.assertRaisesRegex(StudyError, r"^nowhere/mesogen cannot be started \(.*\); give the command with "
                                                "--mesogen$"):
            Program("nowhere/mesogen")

    def test_a_program_that_has_no_schema(self):
        with self.assertRaisesRegex(StudyError, "^/bin/ls schema failed: .*schema"):
            Program("/bin/ls")

    def test_without_a_program_all_runs_count(self):
        rows = [{"version": "mesogen 0.1.0, defaults 0123456789ab"}]
        self.assertEqual(of_same_defaults(rows, "nowhere/mesogen"), rows)

    def test_defaults_of_plugins_that_a_case_does_not_name_do_not_count(self):
        found = list(_defaults(SCHEMA, ()))
        self.assertEqual(found, [(("time", "factor"), 1.0), (("physics.wcsph", "shift"), 0.3),
                                 (("observer.new", "count"), 16)])
        self.assertEqual([_used(path, {"wcsph"}) for path, _ in found], [True, True, False])


class FakeProgram(synthetic.FolderTest):
    """A program that prints a version and a schema."""

    def program(self, schema):
        os.makedirs(self.folder, exist_ok=True)
        file = os.path.join(self.folder, "mesogen")
        with open(file, "w", encoding="utf-8") as stream:
            stream.write("#!/bin/sh\n"
                         f"case $1 in --version) echo 'mesogen 1';; schema) echo '{json.dumps(schema)}';; esac\n")
        os.chmod(file, 0o755)
        return file

    def test_runs_count_until_a_default_changes(self):
        rows = [{"version": Program(self.program(SCHEMA)).version_for()}]
        self.assertRegex(rows[0]["version"], "^mesogen 1, defaults [0-9a-f]{12}$")
        described = {**SCHEMA, "description": "other words",
                     "properties": {**SCHEMA["properties"], "new": {"type": "text"}}}
        self.assertEqual(of_same_defaults(rows, self.program(described)), rows)
        other = json.loads(json.dumps(SCHEMA).replace("0.3", "0.4"))
        self.assertEqual(of_same_defaults(rows, self.program(other)), [])

    def test_only_plugins_that_a_case_names_count(self):
        other = json.loads(json.dumps(SCHEMA).replace("16", "17"))
        one, two = Program(self.program(SCHEMA)), Program(self.program(other))
        case = {"physics": {"flow": {"type": "wcsph"}}}
        self.assertEqual(one.version_for(case), two.version_for(case))
        self.assertNotEqual(one.version_for(case, {"observers.more.type": "new"}),
                            two.version_for(case, {"observers.more.type": "new"}))


if __name__ == "__main__":
    unittest.main()
