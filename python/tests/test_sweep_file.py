"""Sweeps as they are read: points, labels, overrides and keys of their runs."""

import os

import synthetic

from mesogen.sweep.collection import Estimate
from mesogen.sweep.defaults import _defaults, _used
from mesogen.sweep.points import short_names, value_word
from mesogen.sweep.slurm import _option_lines
from mesogen.sweep.sweep_file import read_sweep
from mesogen.sweep.tables import estimate_text

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

    def test_estimates_show_two_digits_of_their_error(self):
        nan = float("nan")
        for numbers, text in (((0.15841, 0.00052, "seeds"), "0.15841 ± 0.00052 (seeds)"),
                              ((1234.5, 12.0, "blocks"), "1234 ± 12 (blocks)"),
                              ((0.5, 0.0, "seeds"), "0.500000 ± 0.000000 (seeds)"),
                              ((0.0, 0.0, "seeds"), "0 ± 0 (seeds)"), ((2.0, nan, ""), "2"), ((nan, nan, ""), "")):
            self.assertEqual(estimate_text(Estimate(*numbers, float("nan"))), text)

    def test_options_of_sbatch(self):
        self.assertEqual(_option_lines("--time=1:00 -p long  --comment 'a b'"), ["--time=1:00", "-p long", "--comment 'a b'"])

    def test_defaults_of_plugins_that_a_case_does_not_name_do_not_count(self):
        schema = {"properties": {"time": {"properties": {"factor": {"default": 1.0}, "default": {"type": "text"}}}},
                  "definitions": {"physics.wcsph": {"properties": {"shift": {"default": 0.3}}},
                                  "observer.new": {"properties": {"count": {"anyOf": [{"default": 16}]}}}}}
        found = list(_defaults(schema, ()))
        self.assertEqual(found, [(("time", "factor"), 1.0), (("physics.wcsph", "shift"), 0.3),
                                 (("observer.new", "count"), 16)])
        self.assertEqual([_used(path, {"wcsph"}) for path, _ in found], [True, True, False])


if __name__ == "__main__":
    synthetic.unittest.main()
