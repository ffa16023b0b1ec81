"""A small scene, its answer and a study of it, for the tests of chart."""

import os

from support import CommandTest

# A sound speed and limits so mild that a run takes a tenth of a second.
CASE = """\
[domain]
size = [1.0, 1.0]
boundary = "periodic_wrap"
[particles]
spacing = 0.1
[kernel]
type = "quintic"
[velocity]
type = "modes"
modes = [[1, 0, 0.15915494309189535, 0.0]]
[physics.flow]
type = "wcsph"
density = 1.0
viscosity = 0.05
[time]
end = 0.2
[observers.flow]
type = "flow_statistics"
interval = 0.1
[run]
precision = "double"
"""

ANSWER = """\
title = "Shear wave"
source = "exact: v_rms = exp(-nu k^2 t) / sqrt(2)"
across = 1.0
[[quantity]]
series = "flow.v_rms"
measure = "value"
at = [0.2]
exact = [0.476438]
"""

STUDY = """\
title = "A small study"
kind = "accuracy"
scene = "scene"
resolutions = [8, 12, 16]
repeats = 2
[common]
"time.factor" = 0.5
[variant.default]
[variant.wendland_c2]
note = "another kernel"
"kernel.type" = "wendland_c2"
[variant.short]
resolutions = [8]
"time.end" = 0.2
"""


class ChartTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.write(CASE, "scene/case.toml")
        self.write(ANSWER, "scene/answer.toml")
        self.write(STUDY, "study.toml")

    def runs(self):
        return self.table("out", "runs.csv")

    def chart(self, *arguments, **more):
        return self.mesogen("chart", "study.toml", "--output", "out", *arguments, **more)

    def refusal(self, study):
        self.write(study, "study.toml")
        out, err = self.chart(code=2)
        self.assertEqual(out, "")
        self.assertFalse(os.path.exists(self.path("out", "runs.csv")))
        return err
