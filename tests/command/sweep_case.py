"""A small case that takes seeds, and a sweep of it, for the tests of sweep."""

import os

from small_case import CASE as SMALL
from support import CommandTest

MODES = 'type = "modes"\nmodes = [[1, 0, 0.2, 0.3], [0, 1, 0.1, 1.1]]'
CASE = SMALL.replace(MODES, 'type = "perturbed"\namplitude = 0.3\nseed = 1')
CASE = CASE.replace("interval = 0.05", "interval = 0.01", 1)
# Half a second and more, with a checkpoint after each step.
LONGER = CASE.replace("end = 0.1", "end = 1.5").replace("[output]", "[output]\ncheckpoint_interval = 0.01")

SWEEP = """\
title = "A small sweep"
case = "case.toml"
seeds = [1, 2]
parallel = 2
[grid]
"physics.activity.activity" = [0.05, -0.05]
[point.thick]
"physics.flow.viscosity" = 1.0
[[quantity]]
series = "flow.v_rms"
from = 0.02
"""
# A run that breaks down: steps of many times their limit, with nothing to land on before.
RUNS_AWAY = """\
[point.runs_away]
"time.factor" = 30.0
"time.end" = 20.0
"observers.flow.interval" = 20.0
"output.interval" = 20.0
"""


class SweepTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.write(CASE, "case.toml")
        self.write(SWEEP, "sweep.toml")

    def sweep(self, *arguments, **more):
        return self.mesogen("sweep", "sweep.toml", "--output", "out", *arguments, **more)

    def start_sweep(self, *arguments):
        return self.start("sweep", "sweep.toml", "--output", "out", *arguments)

    def refusal(self, sweep, *arguments):
        """What is said against a sweep; nothing was run."""
        self.write(sweep, "sweep.toml")
        out, err = self.sweep(*arguments, code=2)
        self.assertEqual(out, "")
        self.assertFalse(os.path.exists(self.path("out", "runs")))
        return err
