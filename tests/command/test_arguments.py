"""Version, help, and arguments that are wrong."""

import os
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

    def refused(self, text, *arguments):
        """The command refuses these arguments with this error."""
        self.assertEqual(self.mesogen(*arguments, code=2), ("", f"error: {text}\n"))

    def test_argument_too_many_is_no_verb(self):
        self.refused('mesogen run: "more" is one argument too many\n  usage: mesogen run CASE [OPTIONS]',
                     "run", "case.toml", "more")

    def test_missing_argument(self):
        self.refused("mesogen run: CASE is missing\n"
                     "  CASE: Case file (TOML), for example cases/quickstart/case.toml\n"
                     "  usage: mesogen run CASE [OPTIONS]", "run")
        self.refused("mesogen plugin new: NAME is missing\n"
                     "  NAME: Name of the plugin, for example my_force\n"
                     "  usage: mesogen plugin new KIND NAME [DIR] [OPTIONS]", "plugin", "new", "physics")

    def test_unknown_option(self):
        for wrong in ("--threds", "--threds=2"):
            self.refused('mesogen run has no option "--threds"; did you mean "--threads"?', "run", "case.toml", wrong)
        self.refused('mesogen graph has no option "-x"; there are: --help, --help-all, --set, --plugin-path, --dot',
                     "graph", "-x")
        self.refused('mesogen graph has no option "--gpu"; there are: --help, --help-all, --set, --plugin-path, --dot',
                     "graph", "--gpu=")

    def test_options_are_not_abbreviated(self):
        self.refused('mesogen run has no option "--over"; did you mean "--overwrite"?', "run", "case.toml", "--over")

    def test_value_of_an_option(self):
        for words in (["--output"], ["-o"], ["--output="]):
            self.refused("mesogen run: --output needs a value: --output DIR", "run", "case.toml", *words)
        self.refused("mesogen run: --quiet takes no value", "run", "case.toml", "--quiet=1")
        self.refused("mesogen run: --output is given twice", "run", "case.toml", "--output=one", "-otwo")
        self.refused('mesogen branch: --at must be a number, not "soon"', "branch", "out", "new", "--at", "soon")

    def test_threads_must_be_a_positive_number(self):
        for wrong in ("0", "-1", "two", "1.5", "99999", ""):
            self.refused(f'mesogen run: --threads must be a whole number from 1 to 4096, not "{wrong}"',
                         "run", "case.toml", "--threads", wrong)

    def test_options_that_need_or_exclude_others(self):
        self.refused("mesogen sweep: --dry-run needs --slurm as well", "sweep", "sweep.toml", "--dry-run")
        self.refused("mesogen sweep: --list excludes --slurm: give one of them",
                     "sweep", "sweep.toml", "--slurm", "--list")
        self.refused('mesogen report: --every must be a whole number of at least 1, not "0"',
                     "report", "out", "--every", "0")
        self.refused('mesogen report: --frame must be a whole number, not "last"', "report", "out", "--frame", "last")

    def test_options_in_every_spelling(self):
        case = self.write_case()
        for number, words in enumerate((["-o"], ["--output"], ["-oout3"], ["--output=out4"]), start=1):
            folder = f"out{number}"
            self.mesogen("run", "--quiet", *words, *([folder] if number < 3 else []), "--set", "time.end=0.02",
                         "--quiet", "--set=output.interval=0.01", case)
            with open(self.path(folder, "case.toml"), encoding="utf-8") as file:
                stored = file.read()
            self.assertRegex(stored, r"(?m)^end = 0\.02$")
            self.assertRegex(stored, r"(?m)^interval = 0\.01$")

    def test_behind_two_dashes_there_are_no_options(self):
        self.write_case(name="-o")
        self.mesogen("check", "--quick", "--", "-o")

    def test_help_of_all_verbs(self):
        out, _ = self.mesogen("--help-all")
        for verb in VERBS:
            self.assertIn(f"Usage: mesogen {' '.join(verb)} ", out)
        out, _ = self.mesogen("plugin", "--help-all")
        self.assertIn("Usage: mesogen plugin new KIND NAME [DIR] [OPTIONS]\n", out)
        self.assertNotIn("Usage: mesogen run", out)

    def test_help_fits_a_terminal(self):
        out, _ = self.mesogen("--help-all")
        self.assertLessEqual(max(map(len, out.splitlines())), 80)
        self.assertIn("\n  -o, --output DIR      Folder for the results (default: output/<name of the\n"
                      "                        case>)\n", self.mesogen("run", "--help")[0])


class FirstLinesOfARun(CommandTest):
    def test_tell_where_results_go_and_how_it_computes(self):
        _, err = self.mesogen("run", self.write_case(name="vortex.toml"))
        self.assertRegex(err, r"\Aresults go to output/vortex\n\d+ particles, \d threads?, ")
        _, err = self.mesogen("run", "vortex.toml", "--output", "mine", "--threads", "2")
        self.assertRegex(err, r"\Aresults go to mine\n\d+ particles, 2 threads, ")

    def test_a_folder_is_no_case(self):
        os.mkdir(self.path("scene"))
        self.write_case(name="scene/vortex.toml")
        _, err = self.mesogen("run", "scene", code=2)
        self.assertEqual(err, "error: scene: cannot be read as a case: it is a folder; give scene/vortex.toml\n")


if __name__ == "__main__":
    unittest.main()
