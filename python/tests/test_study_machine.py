"""Which recorded runs still count."""

import unittest

from mesogen.study.errors import StudyError
from mesogen.study.machine import of_same_defaults, program_text


class Machine(unittest.TestCase):
    def test_a_program_that_is_not_there(self):
        with self.assertRaisesRegex(StudyError, r"^nowhere/mesogen cannot be started \(.*\); give the command with --mesogen$"):
            program_text("nowhere/mesogen")

    def test_without_a_program_there_is_nothing_to_compare_with(self):
        rows = [{"version": "mesogen 0.1.0, defaults 0123456789ab"}]
        self.assertEqual(of_same_defaults(rows, "nowhere/mesogen"), rows)

    def test_a_program_that_has_no_schema(self):
        with self.assertRaisesRegex(StudyError, "^/bin/ls schema failed: .*schema"):
            program_text("/bin/ls")


if __name__ == "__main__":
    unittest.main()
