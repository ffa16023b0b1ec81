"""What study.toml may say, and what is said against it."""

import os
import unittest

import synthetic

from mesogen.errors import StudyError
from mesogen.study.study_file import read_study

SECTION = 'TITLE, FIGURE, SWEEPS = "Speed", "v rms", ["activity", "other"]\n\ndef write(section):\n    pass\n'


class StudyFile(synthetic.FolderTest):
    def setUp(self):
        super().setUp()
        self.put("speed.py", SECTION)
        self.put("activity.toml", "")
        self.put("other.toml", "")

    def put(self, name, text):
        os.makedirs(self.folder, exist_ok=True)
        with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
            file.write(text)

    def read(self, text, *arguments):
        self.put("study.toml", text)
        return read_study(self.folder, *arguments)

    def assert_refused(self, text, words, *arguments):
        with self.assertRaises(StudyError) as caught:
            self.read(text, *arguments)
        self.assertIn(words, str(caught.exception))

    def test_sections_and_their_sweeps(self):
        study = self.read('title = "T"\nsections = ["speed"]\n')
        self.assertEqual((study.title, study.sections[0].title, study.sweeps), ("T", "Speed", ("activity", "other")))

    def test_a_mode_changes_keys_and_seeds(self):
        text = 'sections = ["speed"]\n[quick.activity]\n"time.end" = 2.0\nseeds = [1]\n'
        self.assertEqual(self.read(text, "quick").changes, {"activity": {"time.end": 2.0, "seeds": [1]}})
        self.assertEqual(self.read(text).changes, {})
        self.assertEqual(self.read(text, "full").changes, {})

    def test_no_study(self):
        with self.assertRaisesRegex(StudyError, "holds no study.toml; give the folder of a study, such as studies/paper"):
            read_study(self.folder + "/nowhere")

    def test_unknown_key_and_lack_of_sections_at_once(self):
        with self.assertRaises(StudyError) as caught:
            self.read('titel = "T"\n')
        self.assertEqual(len(caught.exception.problems), 2)
        self.assertIn("sections: is missing; it is a list of different texts", caught.exception.problems[0])
        self.assertIn("titel: no such key; did you mean 'title'?", caught.exception.problems[1])
        self.assert_refused("sections = []", "sections: must name one section or more")

    def test_missing_files(self):
        self.assert_refused('sections = ["sped"]', "sped.py: no such file; study.toml has a section 'sped'")
        os.remove(os.path.join(self.folder, "other.toml"))
        self.assert_refused('sections = ["speed"]', "other.toml: no such sweep; a section of")

    def test_incomplete_section(self):
        self.put("speed.py", 'TITLE = "Speed"\n')
        self.assert_refused('sections = ["speed"]', "speed.py: a section must have SWEEPS, write")

    def test_only_what_there_is(self):
        self.assert_refused('sections = ["speed"]', "has no section 'sped'", "quick", ["sped"])

    def test_mistakes_in_sections(self):
        self.put("speed.py", 'TITLE = "Speed"\nSWEEPS = "activity"\n\ndef write(section):\n    pass\n')
        self.assert_refused('sections = ["speed"]', 'speed.py: SWEEPS must be a list of names, ["activity"]')
        self.put("speed.py", 'TITLE = "Speed"\nSWEEPS = (\n')
        self.assert_refused('sections = ["speed"]', "speed.py:2: ")
        self.put("speed.py", 'TITLE = "Speed"\nSWEEPS = [name]\n')
        self.assert_refused('sections = ["speed"]', "speed.py:2: NameError: name 'name' is not defined")

    def test_changes_of_any_mode_are_checked(self):
        self.assert_refused('sections = ["speed"]\n[full.activty]\nseeds = [1]\n',
                            'full.activty: no such sweep; did you mean')
        self.assert_refused('quick = true\nsections = ["speed"]\n', "quick: must be one or more tables [quick.NAME]")
        for seeds in ("3", "[]", "[1, 1]", "[-1]", '["a"]', "[true]"):
            self.assert_refused(f'sections = ["speed"]\n[quick.activity]\nseeds = {seeds}\n',
                                "quick.activity.seeds: must be a list of different whole numbers, each at least 0")

    def test_wrong_changes(self):
        self.assert_refused('sections = ["speed"]\n[quick.activity]\nend = 2.0\n',
                            'quick.activity.end: is no dotted key of a case such as "kernel.type", nor is it one of: seeds', "quick")
        self.assert_refused('sections = ["speed"]\n[quick]\nend = 2.0\n',
                            "quick: must be one or more tables [quick.NAME]", "quick")


if __name__ == "__main__":
    unittest.main()
