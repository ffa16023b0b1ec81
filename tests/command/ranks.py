"""Helpers of the tests of runs on several processes."""

import os
import shutil
import subprocess
import unittest

import h5py
import numpy
from support import CASE, MESOGEN, CommandTest

MPI = os.environ.get("MPI", "") in ("ON", "TRUE", "1") and shutil.which("mpirun")
HOW = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1",
       "OMPI_MCA_btl_base_warn_component_unused": "0"}
OBSERVERS = """
[observers.nematic]
type = "nematic_statistics"
interval = 0.05
[observers.defects]
type = "defects"
interval = 0.05
[observers.mixing]
type = "mixing"
interval = 0.05
[observers.paths]
type = "pathlines"
count = 5
[observers.spectrum]
type = "energy_spectrum"
interval = 0.05
[observers.correlation]
type = "correlation"
interval = 0.05
"""
JITTERED = CASE.replace("spacing = 0.1", 'spacing = 0.1\narrangement = "jittered"\nseed = 3')
WALLS = '{ type = "walls", axes = ["y"], anchoring = "planar" }'
DISC = """
[solids.post]
shape = "disc"
centre = [0.8, 0.8]
radius = 0.3
anchoring = "tangential"
"""


def at_boundary(boundary):
    return JITTERED.replace('boundary = "periodic_ghosts"', f"boundary = {boundary}")


@unittest.skipUnless(MPI, "built without MPI (scripts/setup --mpi)")
class RanksTest(CommandTest):
    def launch(self, ranks, *arguments):
        return ["mpirun", "-n", str(ranks), MESOGEN, *arguments, "--threads", "1"]

    def ranks(self, ranks, *arguments, code=0, **environment):
        """Runs the command on so many processes; returns what they wrote to stderr."""
        done = subprocess.run(self.launch(ranks, *arguments), cwd=self.folder, text=True, capture_output=True,
                              env=self.environment(**HOW, **environment), timeout=300, check=False)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stderr

    def start_ranks(self, ranks, *arguments):
        """Starts them, and waits for their first checkpoint."""
        process = subprocess.Popen(self.launch(ranks, *arguments), cwd=self.folder, env=self.environment(**HOW),
                                   text=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.wait_for(process, "out", "checkpoint_a.h5")
        return process

    def results(self, folder):
        """All numbers of a run by their place in results.h5: of particles those of the last frame."""
        found = {}

        def take(name, item):
            if isinstance(item, h5py.Dataset) and item.dtype.kind in "fiu" and name.split("/")[0] in ("particles",
                                                                                                     "observables"):
                last = name.startswith("particles") and name.endswith("value")
                found[name] = numpy.asarray(item[-1] if last else item, dtype=float)
        with h5py.File(self.path(folder, "results.h5"), "r") as file:
            file.visititems(take)
        return found

    def expect_same(self, folder, other, bound=0.0):
        """The same numbers, to a bound of the largest of each quantity."""
        expected, found = self.results(folder), self.results(other)
        self.assertEqual(sorted(expected), sorted(found))
        self.assertIn("particles/fluid/order_tensor/value", expected)
        for name, values in expected.items():
            if "momentum" in name and bound > 0.0:  # which is rounding itself
                continue
            known = ~numpy.isnan(values)
            self.assertTrue(numpy.array_equal(known, ~numpy.isnan(found[name])), name)
            off = numpy.abs(found[name] - values)[known].max(initial=0.0)
            self.assertLessEqual(off, bound * max(1.0, numpy.abs(values[known]).max(initial=0.0)), name)
