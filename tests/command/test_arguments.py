"""Version, help, and arguments that are wrong."""

import unittest

from support import VERBS, CommandTest


class Arguments(CommandTest):
    def test_version(self):
        out, err = self.mesogen("--version")
        self.assertRegex(out, r"^mesogen \d+\.\d+\.\d+ \(.*abi.*\)$")
        self.assertEqual(err, "")

    def test_help_of_the_command_names_every_verb(self):
        out, _ = self.mesogen("--help")
        for verb in ("run", "resume", "replay", "check", "graph", "plugin", "field", "schema", "reference", "report",
                     "chart", "sweep", "study"):
            self.assertRegex(out, rf"(?m)^  {verb} ")

    def test_every_verb_has_help(self):
        for verb in VERBS:
            out, err = self.mesogen(*verb, "--help")
            self.assertIn("Usage: mesogen " + " ".join(verb), out)
            self.assertEqual(err, "")

    def test_help_of_run_names_its_options(self):
        out, _ = self.mesogen("run", "--help")
        for option in ("--set", "--output", "--overwrite", "--threads", "--quiet", "--plugin-path", "--profile",
                       "--trace"):
            self.assertIn(option, out)

    def test_without_a_verb(self):
        out, err = self.mesogen(code=2)
        self.assertEqual(out, "")
        self.assertIn("Usage: mesogen", err)
        for group in ("plugin", "field"):
            _, err = self.mesogen(group, code=2)
            self.assertIn(f"Usage: mesogen {group}", err)
            self.assertIn("list", err)

    def test_unknown_verb(self):
        for wrong, text in ((["rnu", "case.toml"], 'mesogen has no verb "rnu"; did you mean "run"?'),
                            (["plugin", "lsit"], 'mesogen plugin has no verb "lsit"; did you mean "list"?'),
                            (["field", "simulate"], 'mesogen field has no verb "simulate"; there are: list')):
            self.assertEqual(self.mesogen(*wrong, code=2), ("", f"error: {text}\n"))
        _, err = self.mesogen("simulate", code=2)
        self.assertRegex(err, r'^error: mesogen has no verb "simulate"; there are: run, resume, .*, study\n$')

    def test_argument_too_many_is_no_verb(self):
        _, err = self.mesogen("run", self.write_case(), "more", code=2)
        self.assertNotIn("verb", err)
        self.assertIn("more", err)

    def test_unknown_option(self):
        _, err = self.mesogen("run", self.write_case(), "--gpu", code=2)
        self.assertIn("--gpu", err)

    def test_missing_case(self):
        _, err = self.mesogen("run", code=2)
        self.assertIn("case is required", err)

    def test_threads_must_be_a_positive_number(self):
        case = self.write_case()
        for wrong in ("0", "-1", "two", "1.5", "99999"):
            _, err = self.mesogen("run", case, "--threads", wrong, code=2)
            self.assertIn("--threads", err)


if __name__ == "__main__":
    unittest.main()
