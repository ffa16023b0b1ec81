"""Runs on several processes: the same results as on one, to rounding; the same bits again; no end without a message."""

import os
import re
import shutil
import signal
import subprocess
import time
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


class Agreement(RanksTest):
    def expect_agreement(self, text, bound=1e-12):
        case = self.write_case(text)
        self.mesogen("run", case, "--output", "one", "--quiet", "--overwrite")
        for ranks in (2, 3):
            self.ranks(ranks, "run", case, "--output", "several", "--quiet", "--overwrite")
            self.expect_same("one", "several", bound)

    def test_with_ghosts_and_all_kinds_of_observers(self):
        self.expect_agreement(JITTERED + OBSERVERS)

    def test_where_the_box_wraps(self):
        self.expect_agreement(at_boundary('"periodic_wrap"'))

    def test_between_walls(self):
        self.expect_agreement(at_boundary(WALLS) + '[observers.force]\ntype = "wall_forces"\ninterval = 0.05\n')

    def test_around_a_solid(self):
        self.expect_agreement(JITTERED + DISC)

    def test_in_explicit_steps(self):
        self.expect_agreement(JITTERED.replace("[time]", '[time]\nstepping = "explicit"'))

    def test_on_a_mesh(self):
        self.expect_agreement(JITTERED.replace('"wcsph"', '"incompressible"') + OBSERVERS)

    def test_in_single_precision(self):
        self.expect_agreement(JITTERED.replace('precision = "double"', 'precision = "single"'), 1e-5)

    # A run that is long enough for particles to change ranks.
    def test_where_particles_change_ranks(self):
        text = JITTERED.replace("[physics.flow]", '[velocity]\ntype = "modes"\nmodes = [[1, 0, 0.3, 0.2]]\n'
                                                  "[physics.flow]").replace("end = 0.1", "end = 0.3")
        self.expect_agreement(text)


# A device that the host plays: what somebody forgot to copy, or never wrote, is not a number there.
class Devices(RanksTest):
    def test_on_the_emulated_device(self):
        library = os.path.join(os.path.dirname(os.path.dirname(MESOGEN)), "lib", "libmesogen_cuda.so")
        if not os.path.exists(library):
            self.skipTest("built without CUDA")
        emulated = {"MESOGEN_CUDA_ON_HOST": "1"}
        case = self.write_case(at_boundary(WALLS))
        on_device = ("--set", 'run.device="cuda"')
        self.mesogen("run", case, "--output", "one", "--quiet", *on_device, **emulated)
        for ranks in (2, 3):
            self.ranks(ranks, "run", case, "--output", "several", "--quiet", "--overwrite", *on_device, **emulated)
            self.expect_same("one", "several", 1e-12)

    def test_no_mesh_on_devices(self):
        library = os.path.join(os.path.dirname(os.path.dirname(MESOGEN)), "lib", "libmesogen_cuda.so")
        if not os.path.exists(library):
            self.skipTest("built without CUDA")
        case = self.write_case(JITTERED.replace('"wcsph"', '"incompressible"'))
        err = self.ranks(2, "run", case, "--output", "out", "--quiet", "--set", 'run.device="cuda"', code=2,
                         MESOGEN_CUDA_ON_HOST="1")
        self.assertIn("several ranks share a mesh on the host alone: set run.device", err)


class SameBits(RanksTest):
    def test_in_two_runs_and_with_two_threads(self):
        case = self.write_case(JITTERED + OBSERVERS)
        self.ranks(2, "run", case, "--output", "first", "--quiet")
        self.ranks(2, "run", case, "--output", "again", "--quiet")
        self.expect_same("first", "again")
        done = subprocess.run(["mpirun", "-n", "2", MESOGEN, "run", case, "--output", "threads", "--quiet", "--threads",
                               "2"], cwd=self.folder, env=self.environment(**HOW), check=False, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.expect_same("first", "threads")

    def test_whoever_looks(self):
        text = JITTERED.replace("end = 0.1", "end = 0.4").replace("[time]", '[time]\nstep = 0.0025')
        case = self.write_case(text)
        often = text.replace("interval = 0.05", "interval = 0.01")
        self.ranks(2, "run", case, "--output", "seldom", "--quiet")
        self.ranks(2, "run", self.write_case(often, "often.toml"), "--output", "often", "--quiet")
        expected, found = self.results("seldom"), self.results("often")
        for field in ("position", "velocity", "order_tensor"):
            name = f"particles/fluid/{field}/value"
            self.assertTrue(numpy.array_equal(expected[name], found[name]), field)


LONGER = JITTERED.replace("end = 0.1", "end = 40.0").replace("interval = 0.05", "interval = 20.0").replace(
    "[output]", "[output]\ncheckpoint_interval = 0.05")


class Interruption(RanksTest):
    def child(self, process):
        """One of the ranks."""
        found = subprocess.run(["pgrep", "-P", str(process.pid)], text=True, capture_output=True, check=False)
        self.assertTrue(found.stdout.split())
        return int(found.stdout.split()[-1])

    def test_a_rank_that_dies_ends_all_and_a_resumed_run_has_the_same_bits(self):
        case = self.write_case(LONGER)
        self.ranks(2, "run", case, "--output", "unbroken", "--quiet")
        process = self.start_ranks(2, "run", case, "--output", "out", "--quiet")
        os.kill(self.child(process), signal.SIGKILL)
        begin = time.time()
        _, err = process.communicate(timeout=60)
        self.assertLess(time.time() - begin, 30.0)
        self.assertNotEqual(process.returncode, 0)
        self.assertIn("signal 9", err)
        self.ranks(2, "resume", "out", "--quiet")
        self.expect_same("unbroken", "out")

    def test_ctrl_c_writes_a_checkpoint(self):
        process = self.start_ranks(2, "run", self.write_case(LONGER), "--output", "out", "--quiet")
        os.kill(self.child(process), signal.SIGTERM)  # one of them is enough
        _, err = process.communicate(timeout=60)
        self.assertIn("mesogen resume out", err)
        self.assertEqual(err.count("mesogen resume out"), 1)

    # Rounding grows with the flow, so not for long.
    def test_other_numbers_of_ranks_go_on_to_rounding(self):
        case = self.write_case(JITTERED + OBSERVERS)
        longer = "time.end=0.2"
        self.ranks(2, "run", case, "--output", "two", "--quiet")
        for ranks in (1, 3):
            shutil.copytree(self.path("two"), self.path(f"by_{ranks}"))
        self.ranks(2, "resume", "two", "--set", longer, "--quiet")
        self.mesogen("resume", "by_1", "--set", longer, "--quiet")
        self.ranks(3, "resume", "by_3", "--set", longer, "--quiet")
        for ranks in (1, 3):
            self.expect_same("two", f"by_{ranks}", 1e-12)

    def test_what_one_process_began_several_go_on_with(self):
        case = self.write_case(JITTERED)
        self.mesogen("run", case, "--output", "one", "--quiet")
        shutil.copytree(self.path("one"), self.path("two"))
        self.mesogen("resume", "one", "--set", "time.end=0.2", "--quiet")
        self.ranks(2, "resume", "two", "--set", "time.end=0.2", "--quiet")
        self.expect_same("one", "two", 1e-12)


class Messages(RanksTest):
    def errors(self, err):
        """Those lines that are Mesogen's."""
        return [line for line in err.splitlines() if line.startswith("error: ")]

    def test_a_mistake_in_the_case_is_told_once(self):
        err = self.ranks(2, "run", self.write_case(CASE.replace("viscosity = 0.5", "viscosity = -0.5")), code=2)
        self.assertEqual(len(self.errors(err)), 1, err)
        self.assertIn("physics.flow.viscosity", self.errors(err)[0])

    def test_the_rank_of_the_worst_particle_tells_how_a_run_broke_down(self):
        text = JITTERED.replace("[time]", '[time]\nstepping = "explicit"\nstep = 0.1').replace("end = 0.1", "end = 9.0")
        _, alone = self.mesogen("run", self.write_case(text), "--output", "one", "--quiet", code=1)
        err = self.ranks(3, "run", self.write_case(text), "--output", "out", "--quiet", code=1)
        told = self.errors(err)
        self.assertEqual(len(told), 1, err)
        self.assertIn("the run ", told[0])
        self.assertEqual(told[0].split("rank ")[-1].split(": ", 1)[-1].split(" (")[0].removeprefix("error: "),
                         alone.splitlines()[0].split(" (")[0].removeprefix("error: "))

    def test_more_ranks_than_rows(self):
        case = self.write_case(CASE)
        err = self.ranks(8, "run", case, "--output", "out", "--quiet", code=2)
        self.assertIn("8 ranks cannot share a box of 7 rows of cells: take at most 7 ranks", err)

    # Each of 2 ranks has 8 rows of 16 particles; it sees those of 4 rows above and below, as many as a support is high,
    # and half of another row of cells where cells are 16/7 rows high.
    def test_the_profile_tells_what_ranks_send(self):
        text = CASE.replace("[time]", '[time]\nstepping = "explicit"').replace("end = 0.1", "end = 0.5")
        case = self.write_case(text.replace("interval = 0.05", "interval = 0.5"))  # readers have ghosts too
        err = self.ranks(2, "run", case, "--output", "out", "--profile")
        told = re.search(r"2 ranks; at most, a rank has (\d+) particles \((.+) % more than the mean\), sees (\d+) of "
                         r"others, sends (\d+) bytes a step for ghosts and (\d+) in all, in .+ messages", err)
        self.assertTrue(told, err)
        particles, above, others, ghosts, everything = (float(number) for number in told.groups())
        self.assertEqual(above, round(100.0 * (particles / 128.0 - 1.0), 1))
        self.assertIn(others, (112.0, 128.0))
        # Two coordinates and seven numbers in double precision a step: volume, velocity, order tensor, compression and
        # pressure. Once more before the first step, which is not counted.
        self.assertAlmostEqual(ghosts / (8 * 9 * others), 1.0, delta=0.1)
        self.assertGreater(everything, ghosts)

    def test_the_log_tells_of_ranks(self):
        err = self.ranks(2, "run", self.write_case(CASE), "--output", "out")
        self.assertIn("256 particles, 2 ranks of 1 thread, double precision", err)
        self.assertEqual(err.count("256 particles"), 1)
        self.assertIn("256 particles, 2 ranks of 1 thread", self.read("out", "run.log"))


if __name__ == "__main__":
    unittest.main()
