"""The page of a report, and what a section puts into its folder."""

import csv
import os
import unittest
from html.parser import HTMLParser

import synthetic

from mesogen.figures import style
from mesogen.study import DOES_NOT_HOLD, HOLDS
from mesogen.study.page import page
from mesogen.study.section import Section
from mesogen.study.study_file import Study


class Links(HTMLParser):
    """Files that a page names, and whether its tags are closed."""

    def __init__(self):
        super().__init__()
        self.files, self.open = [], []

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        self.files += [attrs[name] for name in ("src", "href") if name in attrs and not attrs[name].startswith("#")]
        if tag not in ("img", "input", "meta"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, tag


class Page(synthetic.FolderTest):
    def setUp(self):
        super().setUp()
        os.makedirs(self.folder, exist_ok=True)
        self.section = Section("speed", "Speed <fast>", "v rms", self.folder, {})
        self.study = Study("Claims & facts", "A. Author", self.folder, "quick", (), {})

    def drawn(self):
        sheet, (axes,) = style.tiles(1, 1, (1.0, 1.0))
        axes.plot([0, 1], [0, 1])
        return sheet

    def test_all_that_it_names_is_there(self):
        self.section.picture("line", self.drawn(), "A line.", ("x", "y"), [(0, 0.0), (1, 1.0 / 3.0)])
        self.section.animation("film", (self.drawn() for _ in range(3)), ("0 s", "1 s", "2 s"), "A film.")
        self.section.table(("a", "b"), [("1", "2")])
        self.section.text("Words.")
        self.section.claim("It is fast.", HOLDS, "3 m/s")
        self.section.claim("It is slow.", DOES_NOT_HOLD, "3 m/s", "No.")
        links = Links()
        links.feed(page(self.study, [self.section], [("version", "1"), ("case", "a = 1\nb = 2")]))
        self.assertEqual(links.open, [])
        self.assertEqual(links.files, ["speed_line.png", "speed_line.csv", "speed_film_002.jpg"])
        for file in [*links.files, "speed_film_000.jpg", "speed_film_001.jpg"]:
            self.assertTrue(os.path.getsize(os.path.join(self.folder, file)) > 0, file)

    def test_numbers_are_beside_the_picture(self):
        self.section.picture("line", self.drawn(), "A line.", ("x", "y"), [(0, 0.0), (1, 1.0 / 3.0)])
        with open(os.path.join(self.folder, "speed_line.csv"), encoding="utf-8", newline="") as file:
            self.assertEqual(list(csv.reader(file)), [["x", "y"], ["0", "0"], ["1", "0.333333"]])

    def test_says_what_holds_and_escapes_what_it_says(self):
        self.section.claim("a < b", HOLDS, "1 < 2")
        text = page(self.study, [self.section], [])
        self.assertIn("1 claim: <span class=\"holds\">1 holds</span>, <span class=\"fails\">0 do not hold</span>", text)
        self.assertIn("a &lt; b", text)
        self.assertIn("Speed &lt;fast&gt;", text)
        self.assertNotIn("<fast>", text)
        self.assertNotIn("http", text)


if __name__ == "__main__":
    unittest.main()
