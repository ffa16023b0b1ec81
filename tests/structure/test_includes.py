"""Dependencies point one way: a folder of the framework includes only folders that stand above it in the table of
ARCHITECTURE.md, nothing of what is built on the framework, and a plugin includes no other plugin."""

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
                path = os.path.relpath(os.path.join(folder, name), ROOT)
                if name.endswith((".hpp", ".cpp", ".cu")) and not path.startswith("app/templates"):
                    yield path


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
    def test_folders_include_those_above_them_in_the_table(self):
        with open(os.path.join(ROOT, "ARCHITECTURE.md"), encoding="utf-8") as file:
            order = re.findall(r"^\| `(framework/\w+)` \|", file.read(), re.MULTILINE)
        found = {arrow: text for arrow, text in arrows().items()
                 if arrow[0].startswith("framework/") and arrow[1] in order}
        self.assertIn(("framework/run", "framework/schedule"), found, "nothing was read")
        self.assertEqual(sorted({start for start, _ in found} - set(order)), [], "folders that the table does not have")
        self.assertEqual([text for (start, end), text in found.items() if order.index(end) > order.index(start)], [])

    def test_the_framework_knows_nothing_above_it(self):
        up = [text for (start, end), text in arrows().items()
              if start.startswith("framework/") and not end.startswith("framework/")]
        self.assertEqual(up, [])

    def test_plugins_include_public_headers_and_their_own(self):
        public = ("framework/include/", "nematics/include/")
        others = [f"{path} includes {other}" for path in sources()
                  if path.startswith("plugins/") and not os.path.basename(path).startswith("test_")
                  for other in included(path) if not other.startswith((*public, os.path.dirname(path) + "/"))]
        self.assertEqual(others, [])


if __name__ == "__main__":
    unittest.main()
