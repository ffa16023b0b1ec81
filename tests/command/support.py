"""Helpers of the tests of the command: run it, and a small case that is right."""

import os
import subprocess
import tempfile
import unittest

MESOGEN = os.environ["MESOGEN"]
BROKEN_PLUGINS = os.environ["BROKEN_PLUGINS"]
PROJECT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
VERBS = [["run"], ["resume"], ["replay"], ["check"], ["graph"], ["plugin"], ["plugin", "list"], ["plugin", "info"],
         ["plugin", "new"], ["plugin", "check"], ["field"], ["field", "list"], ["schema"], ["reference"], ["report"]]

CASE = """\
title = "A small nematic"
[domain]
size = [1.6, 1.6]
boundary = "periodic_ghosts"
[particles]
spacing = 0.1
[kernel]
type = "quintic"
smoothing_length = 1.3333
[director]
type = "modes"
modes = [[1, 0, 0.2, 0.3], [0, 1, 0.1, 1.1]]
[physics.flow]
type = "wcsph"
density = 1.0
viscosity = 0.5
[physics.nematic]
type = "beris_edwards"
rotational_diffusivity = 0.4
flow_alignment = 0.7
elastic_constant = 0.02
bulk = { A = -1.0, B = 0.0, C = 0.5 }
[physics.activity]
type = "active_stress"
activity = 0.05
[time]
end = 0.1
[observers.flow]
type = "flow_statistics"
interval = 0.05
[output]
interval = 0.05
[run]
precision = "double"
"""


class CommandTest(unittest.TestCase):
    """A test with a folder of its own, in which the command runs."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="mesogen-")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, *parts):
        return os.path.join(self.folder, *parts)

    def write_case(self, text=CASE, name="case.toml"):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def environment(self, **more):
        kept = {name: value for name, value in os.environ.items() if not name.startswith("MESOGEN_")}
        return {"OMP_NUM_THREADS": "1", **kept, **more}

    def mesogen(self, *arguments, code=0, **environment):
        """Runs the command, which must answer with this exit code; returns what it wrote to stdout and stderr."""
        done = subprocess.run([MESOGEN, *arguments], cwd=self.folder, env=self.environment(**environment), text=True,
                              capture_output=True, timeout=300, check=False)
        self.assertEqual(done.returncode, code, f"mesogen {' '.join(arguments)}: {done.stdout}{done.stderr}")
        return done.stdout, done.stderr
