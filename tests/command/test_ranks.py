"""Runs on several processes: the same results as on one, to rounding, and the same bits again."""

import subprocess
import unittest

import numpy
from ranks import DISC, HOW, JITTERED, OBSERVERS, WALLS, RanksTest, at_boundary
from support import MESOGEN


class Agreement(RanksTest):
    def expect_agreement(self, text, bound=1e-12, ranks=(2, 3)):
        case = self.write_case(text)
        self.mesogen("run", case, "--output", "one", "--quiet", "--overwrite")
        for number in ranks:
            self.ranks(number, "run", case, "--output", "several", "--quiet", "--overwrite")
            self.expect_same("one", "several", bound)

    def test_with_ghosts_and_all_kinds_of_observers(self):
        self.expect_agreement(JITTERED + OBSERVERS)

    def test_where_the_box_wraps(self):
        self.expect_agreement(at_boundary('"periodic_wrap"'))

    def test_between_walls(self):
        self.expect_agreement(at_boundary(WALLS) + '[observers.force]\ntype = "wall_forces"\ninterval = 0.05\n')

    def test_around_a_solid(self):
        self.expect_agreement(JITTERED + DISC)

    # The fluid is a small disc in the middle: most ranks have no particle.
    def test_where_ranks_have_no_particles(self):
        small = DISC.replace("radius = 0.3", 'radius = 0.35\nfluid = "inside"')
        self.expect_agreement(JITTERED.replace("[1.6, 1.6]", "[1.6, 3.2]") + small, ranks=(2, 7, 12))

    def test_between_walls_along_the_other_axis(self):
        self.expect_agreement(at_boundary(WALLS.replace('"y"', '"x"')))

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

if __name__ == "__main__":
    unittest.main()
