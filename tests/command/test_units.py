"""[units]: they label what a run says and writes, and no number changes; and an experiment runs in any of them."""

import os
import sys

import numpy as np
from support import BROKEN_PLUGINS, PROJECT, CommandTest

sys.path.insert(0, os.path.join(PROJECT, "python"))
import mesogen  # noqa: E402

FILM = """\
title = "film of 40 x 20 um between walls"
[domain]
size = [{length:g}, {width:g}]
boundary = {{ type = "walls", anchoring = "planar" }}
[particles]
spacing = {spacing:g}
[kernel]
type = "quintic"
[director]
type = "modes"
modes = [[1, 1, 0.1, 0.3], [2, 1, 0.05, 1.1]]
[physics.flow]
type = "wcsph"
density = {density:g}
viscosity = 0.1
inertia = false
[physics.nematic]
type = "beris_edwards"
rotational_diffusivity = 1.0
flow_alignment = 0.7
elastic_constant = {elastic_constant:g}
bulk = {{ A = -1.0, C = 0.5 }}
[physics.activity]
type = "active_stress"
activity = 0.5
[time]
end = 0.02
[observers.flow]
type = "flow_statistics"
interval = 1.0
[run]
precision = "{precision}"
"""
SI = {"length": 40e-6, "width": 20e-6, "spacing": 1e-6, "density": 1000.0, "elastic_constant": 4e-12}
# Pa is pN/um2; 1 kg/m3 is 1e-12 pN s2/um4.
FILM_UNITS = {"length": 40.0, "width": 20.0, "spacing": 1.0, "density": 1e-9, "elastic_constant": 4.0}
UNITS = '[units]\nlength = "um"\ntime = "s"\nforce = "pN"\n'


class Units(CommandTest):
    def film(self, precision, in_si):
        text = FILM.format(**(SI if in_si else FILM_UNITS), precision=precision) + ("" if in_si else UNITS)
        name = f"{precision}_{in_si}"
        self.mesogen("run", self.write_case(text, f"{name}.toml"), "--output", self.path(name))
        return mesogen.open(self.path(name))

    def test_an_experiment_is_the_same_in_metres_and_in_micrometres(self):
        # Lengths of 1e-6 m, W of 1e12 / m2, its slopes over distances of 1e24 / m4: float holds them.
        for precision, close in (("single", 2e-5), ("double", 1e-9)):
            with self.film(precision, True) as metres, self.film(precision, False) as micrometres:
                np.testing.assert_allclose(metres["order_tensor"], micrometres["order_tensor"], atol=close)
                u = micrometres["velocity"]
                self.assertGreater(np.abs(u).max(), 0.1)
                np.testing.assert_allclose(1e6 * metres["velocity"], u, atol=close * np.abs(u).max())
                energy = [run.series("flow", "kinetic_energy")[1][-1] for run in (metres, micrometres)]
                self.assertAlmostEqual(1e12 * energy[0] / energy[1], 1.0, delta=10 * close)

    def test_results_say_in_which_units_they_are(self):
        with self.film("single", False) as run:
            self.assertEqual((run.length_unit, run.time_unit), ("um", "s"))
            self.assertEqual(run.unit("position"), "um")
            self.assertIn("um", run.unit("velocity"))
            self.assertIn("pN", run.series_unit("flow", "density_min"))
            self.assertEqual(run.box[0], 40.0)
            self.assertIn("800 particles, 2 frames to t = 0.02 s", repr(run))
        text = FILM.format(**FILM_UNITS, precision="single") + UNITS.replace('"s"', '"ms"')
        self.mesogen("run", self.write_case(text), "--output", "ms", "--quiet")
        with mesogen.open(self.path("ms")) as run:
            self.assertIn("800 particles, 2 frames to t = 0.02 ms", repr(run))

    def test_messages_and_numbers_are_in_them(self):
        case = self.write_case(FILM.format(**FILM_UNITS, precision="single") + UNITS)
        out, _ = self.mesogen("check", case, "--quick")
        for part in ("box             40 um x 20 um", "spacing 1 um", "14.14 um/s", "pN s2/um4",
                     "momentum relaxes at least 20 times faster"):
            self.assertIn(part, out)
        _, err = self.mesogen("check", case, "--quick", "--set", "physics.flow.viscosity=0", code=2)
        self.assertIn("physics.flow.viscosity: must be > 0 pN s/um2, but is 0", err)
        _, err = self.mesogen("check", case, "--quick", "--set", "units.length=1e-6", code=2)
        self.assertIn("units.length: must be a text, but is 1e-06", err)

    def test_refusals_are_in_them(self):
        text = FILM.format(**FILM_UNITS, precision="single") + UNITS.replace('"s"', '"ms"')
        defects = text.replace('type = "modes"\nmodes = [[1, 1, 0.1, 0.3], [2, 1, 0.05, 1.1]]',
                               'type = "defects"\ndefects = [[10.0, 30.0, 0.5]]')
        for wrong, settings, expected in (
                (text.replace("[40, 20]", "[4e-9, 2e-9]"), ["particles.spacing=1e-10"], r"spacings go from \S+ to \S+ um; "),
                (defects, [], "row 1: must lie in the box, y from 0 to 20 um, where this axis ends at walls, but is at 30"),
                (text, ["particles.spacing=0.0007"], r"particles fit, with a spacing of \S+ um"),
                (text, ["observers.flow.interval=1e-14"], r"choose at least \S+ ms"),
                (text, ["output.interval=1e-13"], r"an interval of \S+ ms or more fits"),
                (text.replace('"walls", anchoring = "planar"', '"wall_nowhere"'), [], r"wall particle 0 is at \(nan, -0.01, 0\) um")):
            arguments = [word for setting in settings for word in ("--set", setting)]
            code = 3 if "wall_nowhere" in wrong else 2
            _, err = self.mesogen("check", self.write_case(wrong), "--quick", *arguments, "--plugin-path",
                                  os.path.join(BROKEN_PLUGINS, "boundaries"), code=code)
            self.assertRegex(err, expected)

    def test_tables_of_studies_are_in_them(self):
        sweep = 'title = "Film"\ncase = "case.toml"\nseeds = [1]\nseed_keys = ["particles.seed"]\n[[quantity]]\n' \
                'series = "flow.v_rms"\nfrom = 0.01\nuntil = 0.02\n'
        self.write_case(FILM.format(**FILM_UNITS, precision="single") + UNITS.replace('"s"', '"ms"'))
        with open(self.path("sweep.toml"), "w", encoding="utf-8") as file:
            file.write(sweep)
        self.mesogen("sweep", "sweep.toml", "--output", "out", "--quiet")
        with open(self.path("out", "table.md"), encoding="utf-8") as file:
            table = file.read()
        self.assertIn("flow.v_rms: mean after 0.01 ms up to 0.02 ms.", table)
        self.assertIn("v_rms (um/ms)", table)


if __name__ == "__main__":
    import unittest

    unittest.main()
