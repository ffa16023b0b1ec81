"""What the tests of scripts/device share: a folder for each, silence on the terminal, where modules are found."""

import contextlib
import io
import pathlib
import sys
import tempfile
import unittest

FOLDER = pathlib.Path(__file__).resolve().parent
PLACES = [str(FOLDER), str(FOLDER.parent)]
sys.path[:0] = PLACES
DEVICE = {"device": "a card", "peak_single_flops_per_second": 60e12, "on_device_bytes_per_second": 4e12,
          "memory_free_bytes": 1e9}


class InFolder(unittest.TestCase):
    """A test with a folder of its own, and silence on the terminal."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="mesogen-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        silence = contextlib.redirect_stdout(io.StringIO())
        silence.__enter__()
        self.addCleanup(silence.__exit__, None, None, None)

    def write(self, text, *name):
        file = self.folder.joinpath(*name)
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
        return file
