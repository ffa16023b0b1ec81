"""Sweeps as they are read: points, labels, overrides and keys of their runs."""

import os

import synthetic

from mesogen.runs.points import short_names, value_word
from mesogen.runs.sweep_file import read_sweep

CASE = '[director]\nseed = 1\n[particles]\nseed = 1\n[time]\nend = 1.0\n[observers.flow]\ntype = "flow_statistics"\n'
SWEEP = """\
title = "x"
case = "case.toml"
seeds = [5, 6]
seed_keys = ["director.seed", "particles.seed"]
[common]
"time.end" = 2.0
"observers.late.type" = "flow_statistics"
[grid]
"domain.size" = [[1.0, 1.0], [2.0, 1.0]]
"kernel.type" = ["quintic", "wendland_c4"]
[point.other]
"time.end" = 3.0
[[quantity]]
series = "late.v_rms"
"""


class SweepFile(synthetic.FolderTest):
    def file(self, text=SWEEP, name="sweep.toml", case=CASE):
        os.makedirs(self.folder, exist_ok=True)
        for one, content in (("case.toml", case), (name, text)):
            with open(os.path.join(self.folder, one), "w", encoding="utf-8") as stream:
                stream.write(content)
        return os.path.join(self.folder, name)

    def test_the_product_of_the_grid_and_points_beside_it(self):
        sweep = read_sweep(self.file())
        self.assertEqual(sweep.name, "sweep")
        self.assertEqual([run.label for run in sweep.runs[:6]], [
            "size_1.0x1.0-type_quintic-seed_5", "size_1.0x1.0-type_wendland_c4-seed_5", "size_2.0x1.0-type_quintic-seed_5",
            "size_2.0x1.0-type_wendland_c4-seed_5", "other-seed_5", "size_1.0x1.0-type_quintic-seed_6"])
        self.assertEqual(len(sweep.runs), 10)
        self.assertEqual(sweep.runs[7].overrides, {
            "time.end": 2.0, "observers.late.type": "flow_statistics", "domain.size": [2.0, 1.0], "kernel.type": "quintic",
            "director.seed": 6, "particles.seed": 6})
        self.assertEqual(sweep.runs[4].overrides["time.end"], 3.0)

    def test_changes_from_python(self):
        path = self.file()
        sweep = read_sweep(path, extra={"time.end": 0.5, "time.factor": 0.5}, seeds=[1], threads=3, parallel=4)
        self.assertEqual([run.overrides["time.end"] for run in sweep.runs], [0.5] * 4 + [3.0])  # the point's own stays
        self.assertEqual({run.overrides["time.factor"] for run in sweep.runs}, {0.5})
        self.assertEqual((sweep.threads, sweep.at_a_time, sweep.seeds), (3, 4, (1,)))

    def test_keys_tell_runs_apart(self):
        first = read_sweep(self.file())
        self.assertEqual(len({run.key for run in first.runs}), 10)
        remarked = self.file(SWEEP.replace('title = "x"', 'title = "y"\nthreads = 2'), case="# a remark\n" + CASE)
        again = read_sweep(remarked)
        self.assertEqual([run.key for run in first.runs], [run.key for run in again.runs])
        other = read_sweep(self.file(case=CASE.replace("end = 1.0", "end = 1.5")))
        self.assertFalse({run.key for run in first.runs} & {run.key for run in other.runs})

    def test_seeds_alone_and_long_labels(self):
        seeds_alone = SWEEP[:SWEEP.index("[grid]")] + SWEEP[SWEEP.index("[[quantity]]"):]
        self.assertEqual([run.label for run in read_sweep(self.file(seeds_alone)).runs], ["seed_5", "seed_6"])
        text = "abcdefghij" * 20
        sweep = read_sweep(self.file(SWEEP.replace('"wendland_c4"', f'"{text}"')))
        self.assertRegex(sweep.points[1].label, r"^size_1\.0x1\.0-type_[a-j]{142}-[0-9a-f]{12}$")

    def test_names_and_values_as_words(self):
        self.assertEqual(short_names(["physics.flow.viscosity", "physics.gas.viscosity", "kernel.type"]), {
            "physics.flow.viscosity": "flow.viscosity", "physics.gas.viscosity": "gas.viscosity", "kernel.type": "type"})
        self.assertEqual([value_word(value) for value in (True, 0.02, -1, "quintic", [1.0, [2, 3]])],
                         ["true", "0.02", "-1", "quintic", "1.0x2x3"])


if __name__ == "__main__":
    synthetic.unittest.main()
