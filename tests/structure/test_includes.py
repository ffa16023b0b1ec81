"""Dependencies point one way: no folder of the framework includes another that includes it, on whatever way, and the
framework includes nothing of what is built on it."""

import os
import re
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
# Where an include may be found, beside the folder of its source.
PLACES = ("framework/include", "nematics/include", "testing/include", "framework", "app", "testing")
FOLDER = {"framework/include/mesogen": "framework", "nematics/include/mesogen": "", "testing/include/mesogen": ""}


def sources():
    for top in ("framework", "nematics", "testing", "plugins", "app"):
        for folder, _, names in os.walk(os.path.join(ROOT, top)):
            for name in names:
                if name.endswith((".hpp", ".cpp", ".cu")) and "templates" not in folder:
                    yield os.path.relpath(os.path.join(folder, name), ROOT)


def part_of(path):
    """The folder that a source belongs to: framework/case, nematics, app."""
    for public, own in FOLDER.items():
        if path.startswith(public):
            path = os.path.join(own, path[len(public) + 1:])
    return "/".join(path.split("/")[:2]) if path.startswith("framework/") else path.split("/")[0]


def included(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        names = re.findall(r'^#include "([^"]+)"', file.read(), re.MULTILINE)
    for name in names:
        for place in (os.path.dirname(path), *PLACES):
            found = os.path.normpath(os.path.join(place, name))
            if os.path.isfile(os.path.join(ROOT, found)):
                yield found
                break


def arrows():
    """(from, to) -> one include that makes this arrow between two folders."""
    found = {}
    for path in sources():
        for other in included(path):
            if part_of(path) != part_of(other):
                found.setdefault((part_of(path), part_of(other)), f"{path} includes {other}")
    return found


class Includes(unittest.TestCase):
    def test_no_arrow_between_folders_returns(self):
        found = arrows()
        self.assertIn(("framework/run", "framework/schedule"), found, "nothing was read")
        beneath = {}
        for start, end in found:
            beneath.setdefault(start, set()).add(end)

        def reached(folder, seen):
            for other in beneath.get(folder, ()):
                if other not in seen:
                    seen.add(other)
                    reached(other, seen)
            return seen

        back = [text for (start, end), text in found.items() if start in reached(end, set())]
        self.assertEqual(back, [], "these includes are part of a circle of folders")

    def test_the_framework_knows_nothing_above_it(self):
        up = [text for (start, end), text in arrows().items()
              if start.startswith("framework/") and not end.startswith("framework/")]
        self.assertEqual(up, [])

    def test_plugins_know_the_public_headers_alone(self):
        public = ("plugins/", "framework/include/", "nematics/include/")
        private = [f"{path} includes {other}" for path in sources()
                   if path.startswith("plugins/") and not os.path.basename(path).startswith("test_")
                   for other in included(path) if not other.startswith(public)]
        self.assertEqual(private, [])


if __name__ == "__main__":
    unittest.main()
