"""elastic_stress: a passive nematic holds from the first step, and its energy only falls."""

import unittest

import h5py
import numpy
from support import CommandTest

CASE = """
[domain]
size = [1.0, 1.0]
boundary = "periodic_wrap"
[particles]
spacing = 0.0625
[kernel]
type = "quintic"
[director]
type = "modes"
modes = [[1, 0, 0.8, 0.3], [0, 1, 0.8, 1.1]]
[physics.flow]
type = "wcsph"
density = 1.0
viscosity = 0.3
[physics.nematic]
type = "beris_edwards"
rotational_diffusivity = 1.0
flow_alignment = 0.5
elastic_constant = 0.02
bulk = { A = -1.0, C = 0.5 }
[physics.elastic]
type = "elastic_stress"
[time]
end = 0.5
[observers.flow]
type = "flow_statistics"
interval = 0.02
[observers.order]
type = "nematic_statistics"
interval = 0.02
[run]
precision = "double"
"""
WALLS = 'domain.boundary={{ type = "walls", axes = ["x", "y"], anchoring = "{}" }}'


class ElasticStress(CommandTest):
    def run_case(self, *settings):
        changed = [word for setting in settings for word in ("--set", setting)]
        self.mesogen("run", self.write_case(CASE), "--output", "out", "--overwrite", *changed)
        with h5py.File(self.path("out", "results.h5")) as file:
            return {name: numpy.asarray(file[f"observables/{observer}/{name}/value"])
                    for observer, name in (("flow", "kinetic_energy"), ("flow", "compression_energy"),
                                           ("flow", "density_min"), ("flow", "density_max"), ("order", "free_energy"))}

    def test_a_jump_at_anchoring_walls_compresses_the_fluid_little(self):
        """Broke at steps 5 to 7 for elastic constants above 0.04 mu^2 / rho."""
        for anchoring in ("planar", "homeotropic"):
            for constant in (0.01, 0.1):
                with self.subTest(anchoring=anchoring, constant=constant):
                    found = self.run_case('director={ type = "uniform" }', WALLS.format(anchoring), "time.end=0.1",
                                          f"physics.nematic.elastic_constant={constant}")
                    self.assertGreater(found["density_min"].min(), 0.85)
                    self.assertLess(found["density_max"].max(), 1.15)

    def test_energy_of_passive_relaxation_never_rises(self):
        """With that of compression, from waves and from a director with noise of 0.3 rad per particle.

        Many more starts, of other scenes: tests/endurance/relaxation.py.
        """
        noise = 'director={ type = "perturbed", amplitude = 0.3, seed = 3 }'
        for flow in ("wcsph", "incompressible"):
            for start in ([], [noise]):
                with self.subTest(flow=flow, start=start):
                    found = self.run_case(f"physics.flow.type={flow}", *start)
                    energy = found["kinetic_energy"] + found["free_energy"]
                    if flow == "wcsph":
                        self.assertGreater(found["compression_energy"].max(), 0.0)
                        energy += found["compression_energy"]
                    self.assertGreater(len(energy), 20)
                    self.assertLess(numpy.diff(energy).max(), 1e-4 * (energy[0] - energy[-1]))


if __name__ == "__main__":
    unittest.main()
