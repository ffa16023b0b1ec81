"""flow_fields: vorticity and stream function in the frames of a run."""

import unittest

import h5py
import numpy
from support import CommandTest

WAVES = [(1, 1, 0.02, 0.3), (2, 0, 0.01, 1.1), (0, 1, -0.015, 2.0)]
LENGTH = numpy.array([2.0, 1.2])
CASE = f"""
title = "Vortices in a box that is no square"
[domain]
size = [2.0, 1.2]
boundary = "periodic_wrap"
[particles]
spacing = 0.05
[kernel]
type = "quintic"
smoothing_length = 1.3333
[velocity]
type = "modes"
modes = {[list(wave) for wave in WAVES]}
[physics.flow]
type = "wcsph"
density = 1.0
viscosity = 0.05
[physics.shown]
type = "flow_fields"
[time]
end = 0.2
[output]
interval = 0.1
fields = ["vorticity", "stream_function"]
[run]
precision = "double"
"""


def known(position):
    """Stream function (m2/s) and vorticity (1/s) of the initial velocity."""
    stream_function, vorticity = 0.0, 0.0
    for mx, my, amplitude, phase in WAVES:
        k = 2 * numpy.pi * numpy.array([mx, my]) / LENGTH
        wave = amplitude * numpy.cos(position @ k + phase)
        stream_function += wave
        vorticity += k @ k * wave
    return stream_function, vorticity


class FlowFields(CommandTest):
    def test_frames_hold_both(self):
        for flow, tolerance in (("wcsph", 0.05), ("incompressible", 2e-3)):
            case = self.write_case(CASE.replace('"wcsph"', f'"{flow}"'))
            self.mesogen("run", case, "--output", flow, "--quiet")
            with h5py.File(self.path(flow, "results.h5"), "r") as results:
                fluid = results["particles/fluid"]
                self.assertEqual(fluid["vorticity/value"].shape, (3, 960), flow)
                self.assertEqual(fluid["stream_function/value"].attrs["unit"], b"m+2 s-1")
                self.assertEqual(fluid["vorticity/value"].attrs["unit"], b"s-1")
                position = fluid["position/value"][:]
                stream_function, vorticity = fluid["stream_function/value"][:], fluid["vorticity/value"][:]
            expected = known(position[0])
            self.assertLess(numpy.abs(stream_function[0] - expected[0]).max(), 2e-4 * expected[0].max())
            self.assertLess(numpy.abs(vorticity[0] - expected[1]).max(), tolerance * expected[1].max())
            # Viscosity: the larger waves of the three decay by less than half.
            self.assertLess(numpy.abs(stream_function[2]).max(), 0.95 * numpy.abs(stream_function[0]).max())
            self.assertGreater(numpy.abs(stream_function[2]).max(), 0.5 * numpy.abs(stream_function[0]).max())

    def test_walls_are_refused_where_the_stream_function_is_asked_for(self):
        walls = CASE.replace('boundary = "periodic_wrap"', 'boundary = { type = "walls", axes = ["y"] }')
        for verb in (["check"], ["run", "--output", "out"]):
            _, err = self.mesogen(verb[0], self.write_case(walls), *verb[1:], code=2)
            self.assertIn("the stream function exists only in a periodic box, and this box has walls: remove "
                          "stream_function from output.fields and from what observers read", err)
        alone = walls.replace(', "stream_function"', "")
        self.mesogen("run", self.write_case(alone), "--output", "vorticity", "--quiet")


if __name__ == "__main__":
    unittest.main()
