"""Helpers of the tests of the command: run it, and a small case that is right."""

import csv
import os
import subprocess
import tempfile
import time
import unittest

from small_case import CASE  # noqa: F401 for the tests that import it from here

MESOGEN = os.environ["MESOGEN"]
BROKEN_PLUGINS = os.environ["BROKEN_PLUGINS"]
PROJECT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
VERBS = [["run"], ["resume"], ["branch"], ["replay"], ["check"], ["graph"], ["plugin"], ["plugin", "list"],
         ["plugin", "info"], ["plugin", "new"], ["plugin", "check"], ["field"], ["field", "list"],
         ["quantity"], ["quantity", "list"], ["schema"], ["reference"], ["report"],
         ["chart"], ["sweep"], ["study"]]


class CommandTest(unittest.TestCase):
    """A test with a folder of its own, in which the command runs."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="mesogen-")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, *parts):
        return os.path.join(self.folder, *parts)

    def write(self, text, *name):
        """Writes a file, and makes the folders in which it lies. Returns its path."""
        os.makedirs(os.path.dirname(self.path(*name)), exist_ok=True)
        with open(self.path(*name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(*name)

    def write_case(self, text=CASE, name="case.toml"):
        return self.write(text, name)

    def read(self, *name):
        """The text of a file."""
        with open(self.path(*name), encoding="utf-8") as file:
            return file.read()

    def table(self, *name):
        """The rows of a CSV file, each a dictionary of texts."""
        with open(self.path(*name), encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def environment(self, **more):
        kept = {name: value for name, value in os.environ.items() if not name.startswith("MESOGEN_")}
        return {"OMP_NUM_THREADS": "1", **kept, **more}

    def mesogen(self, *arguments, code=0, **environment):
        """Runs the command, which must answer with this exit code; returns what it wrote to stdout and stderr."""
        done = subprocess.run([MESOGEN, *arguments], cwd=self.folder, env=self.environment(**environment), text=True,
                              capture_output=True, timeout=300, check=False)
        self.assertEqual(done.returncode, code, f"mesogen {' '.join(arguments)}: {done.stdout}{done.stderr}")
        return done.stdout, done.stderr

    def start(self, *arguments, **how):
        """Starts the command and returns the process, whose stderr is a pipe. how: further arguments of Popen."""
        process = subprocess.Popen([MESOGEN, *arguments], cwd=self.folder, env=self.environment(), text=True,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, **how)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def wait_for(self, process, *name):
        """Waits until a process has written a file."""
        deadline = time.time() + 60
        while not os.path.exists(self.path(*name)):
            self.assertLess(time.time(), deadline, f"no {os.path.join(*name)}")
            self.assertIsNone(process.poll(), "ended too early")
            time.sleep(0.01)
