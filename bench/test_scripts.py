#!/usr/bin/python3
"""Every script of this folder finds what it imports: what nobody runs for weeks breaks unseen."""

import importlib
import pathlib
import sys
import unittest

FOLDER = pathlib.Path(__file__).resolve().parent
SCRIPTS = sorted(file for place in ("", "device", "peers", "reference") for file in (FOLDER / place).glob("*.py")
                 if not file.name.startswith(("test_", "__")))


class Scripts(unittest.TestCase):
    def test_each_can_be_imported(self):
        self.assertGreater(len(SCRIPTS), 10)
        for file in SCRIPTS:
            with self.subTest(file.relative_to(FOLDER)):
                sys.path.insert(0, str(file.parent))
                try:
                    importlib.import_module(file.stem)
                finally:
                    sys.path.remove(str(file.parent))


if __name__ == "__main__":
    unittest.main()
