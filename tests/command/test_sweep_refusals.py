"""sweep: files and arguments that are wrong."""

import fcntl
import os
import unittest

from sweep_case import CASE, SWEEP, SweepTest


class Refusals(SweepTest):
    def test_no_sweep(self):
        _, err = self.mesogen("sweep", "nothing.toml", code=2)
        self.assertEqual(err, "error: nothing.toml: the sweep cannot be read: No such file or directory\n")
        _, err = self.mesogen("sweep", code=2)
        self.assertIn("mesogen sweep: SWEEP is missing", err)
        self.assertTrue(self.refusal("title = ").startswith("error: sweep.toml: the sweep is not TOML: "))

    def test_no_case(self):
        self.assertEqual(self.refusal(SWEEP.replace("case.toml", "cases.toml")),
                         "error: cases.toml: the sweep's case cannot be read: No such file or directory\n")

    def test_keys_that_are_not_there(self):
        wrong = SWEEP.replace("seeds =", "seed =").replace("from", "form").replace("[grid]", "[grids]")
        self.assertEqual(self.refusal(wrong).splitlines(), [
            "errors:",
            "sweep.toml: quantity[1].form: no such key; did you mean 'from'?",
            "sweep.toml: seed: no such key; did you mean 'seeds'?",
            "sweep.toml: grids: no such key; did you mean 'grid'?",
        ])

    def test_values_that_are_none(self):
        wrong = SWEEP.replace("[1, 2]", "[1, 1]").replace("parallel = 2", 'parallel = "all"\nthreads = 0\ntimeout = 0')
        wrong = wrong.replace("from = 0.02", "from = 0.2\nuntil = 0.2\nblocks = 1").replace("flow.v_rms", "v_rms")
        self.assertEqual(self.refusal(wrong).splitlines(), [
            "errors:",
            "sweep.toml: seeds: must be a list of different whole numbers, each at least 0",
            "sweep.toml: threads: must be a whole number, at least 1",
            'sweep.toml: parallel: must be a whole number, at least 1, or "auto"',
            "sweep.toml: timeout: must be a number above 0",
            "sweep.toml: quantity[1].series: 'v_rms' must be OBSERVER.QUANTITY, the observer as the case names it",
            "sweep.toml: quantity[1].blocks: must be a whole number, at least 2",
            "sweep.toml: quantity[1].until: must be after from = 0.2",
        ])

    def test_a_grid_that_is_none(self):
        for wrong in ("[]", "0.05"):
            self.assertEqual(self.refusal(SWEEP.replace("[0.05, -0.05]", wrong)),
                             'error: sweep.toml: grid."physics.activity.activity": must be a list of one or more values\n')
        self.assertEqual(self.refusal(SWEEP.replace('"physics.activity.activity"', "activity")),
                         'error: sweep.toml: grid.activity: is no dotted key of a case such as "kernel.type"\n')

    def test_nothing_to_change(self):
        self.assertEqual(self.refusal('title = "x"\ncase = "case.toml"\n[[quantity]]\nseries = "flow.v_rms"\n'),
                         "error: sweep.toml: nothing changes from run to run: give [grid], [point.NAME] or seeds\n")
        self.assertEqual(self.refusal(SWEEP.replace('"physics.flow.viscosity" = 1.0', "")),
                         "error: sweep.toml: point.thick: changes nothing; give it keys of the case\n")

    def test_points_that_share_a_folder(self):
        advice = "is there twice: its runs would share a folder; leave one of them out, or name it in a [point.NAME]\n"
        self.assertEqual(self.refusal(SWEEP.replace("-0.05", "0.05")), f"error: sweep.toml: point 'activity_0.05' {advice}")
        self.assertEqual(self.refusal(SWEEP.replace("[point.thick]", '[point."activity_0.05"]')),
                         f"error: sweep.toml: point 'activity_0.05' {advice}")
        self.assertEqual(self.refusal(SWEEP.replace("[point.thick]", '[point."../thick"]')),
                         'error: sweep.toml: point."../thick": the name is a folder\'s too: letters, digits, _ . + and - '
                         'alone\n')

    def test_seeds_that_reach_nothing(self):
        self.assertEqual(self.refusal('seed_keys = ["director.sed"]\n' + SWEEP),
                         'error: sweep.toml: every point: --set: director.sed: unknown key; did you mean "seed"?\n')
        self.write(CASE.replace('type = "perturbed"\namplitude = 0.3\nseed = 1', 'type = "uniform"'), "case.toml")
        self.assertEqual(self.refusal(SWEEP), "error: sweep.toml: every point: --set: director.seed: has a meaning only with "
                                              'type = "perturbed"\n')
        self.write(CASE, "case.toml")
        self.assertEqual(self.refusal(SWEEP.replace("[grid]", '[grid]\n"director.seed" = [1, 2]')),
                         "error: sweep.toml: director.seed: is set by the seeds; leave it out\n")
        self.assertEqual(self.refusal('seed_keys = ["director.seed"]\n' + SWEEP.replace("seeds = [1, 2]\n", "")),
                         "error: sweep.toml: seed_keys: means nothing without seeds\n")

    def test_quantities_that_are_not_there(self):
        self.assertEqual(self.refusal(SWEEP.replace('"flow.v_rms"', '"flaw.v_rms"')),
                         "error: sweep.toml: quantity[1].series: case.toml has no observer 'flaw'; did you mean 'flow'?\n")
        self.assertEqual(self.refusal(SWEEP + '[[quantity]]\nseries = "flow.v_rms"\n'),
                         "error: sweep.toml: quantity 'flow.v_rms' is there twice: give one of them another name\n")

    def test_what_a_run_does_not_record(self):
        self.assertEqual(self.refusal(SWEEP.replace("v_rms", "v_rsm")),
                         "error: sweep.toml: every point: quantity[1].series: observer 'flow' records no 'v_rsm'; did you "
                         "mean 'v_rms'?\n")
        self.assertEqual(self.refusal(SWEEP.replace("v_rms", "total_momentum")),
                         "error: sweep.toml: every point: quantity[1].series: 'flow.total_momentum' is a table in each "
                         "sample; a sweep collects numbers\n")
        # Only where the observer is of another type.
        self.assertIn("error: sweep.toml: thick: quantity[1].series: observer 'flow' records no 'v_rms'; there are: "
                      "distance, id, path",
                      self.refusal(SWEEP.replace("[point.thick]", '[point.thick]\n"observers.flow.type" = "pathlines"')))

    def test_two_sweeps_of_one_name(self):
        self.sweep("--quiet")
        os.mkdir(self.path("other"))
        for name in ("sweep.toml", "case.toml"):
            with open(self.path(name), encoding="utf-8") as file:
                self.write(file.read().replace("seeds = [1, 2]", "seeds = [1, 2, 3]"), os.path.join("other", name))
        _, err = self.mesogen("sweep", "other/sweep.toml", "--output", "out", code=2)
        self.assertRegex(err, r"^error: out holds the runs of /\S+/sweep\.toml, another sweep: give --output DIR, or rename "
                              r"other/sweep\.toml\n$")

    def test_a_span_without_samples_in_the_units_of_the_case(self):
        with open(self.path("case.toml"), "a", encoding="utf-8") as file:
            file.write('[units]\ntime = "ms"\n')
        self.assertEqual(self.refusal(SWEEP.replace("from = 0.02", "from = 5.0")),
                         "error: sweep.toml: quantity[1].from: 5 ms, but no run goes on beyond 'time.end' = 0.1 ms\n")

    def test_a_span_without_samples(self):
        self.assertEqual(self.refusal(SWEEP.replace("from = 0.02", "from = 5.0")),
                         "error: sweep.toml: quantity[1].from: 5 s, but no run goes on beyond 'time.end' = 0.1 s\n")
        self.write(SWEEP.replace("from = 0.02", "from = 0.07\nuntil = 0.09") + '[common]\n"observers.flow.interval" = 0.06\n', "sweep.toml")
        out, _ = self.sweep("--quiet")
        self.assertRegex(out, r"\n- activity_0\.05-seed_1, activity_-0\.05-seed_1, thick-seed_1 and 3 more: flow\.v_rms has no "
                              r"sample after 0\.07 s.* 0\.09 s; the last is at 0\.1\d* s\n")

    def test_what_mesogen_refuses(self):
        err = self.refusal(SWEEP + '[common]\n"physics.flow.viscosty" = 1.0\n')
        self.assertRegex(err, r"^error: sweep\.toml: every point: --set: physics\.flow\.viscosty: unknown key; did you mean "
                              r'"viscosity"\?')
        err = self.refusal(SWEEP.replace("= 1.0", "= -1.0") + '[point.cubic]\n"kernel.type" = "cubic"\n')
        self.assertIn("sweep.toml: thick: --set: physics.flow.viscosity: ", err)
        self.assertIn('sweep.toml: cubic: --set: kernel.type: no kernel plugin is called "cubic"', err)

    def test_a_run_that_another_process_is_at(self):
        os.makedirs(self.path("out", "state", "thick-seed_1"))
        open(self.path("out", ".lock"), "w", encoding="ascii").close()  # the folder is a sweep's
        with open(self.path("out", "state", "thick-seed_1", ".lock"), "w", encoding="ascii") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            _, err = self.sweep("--quiet", code=2)
        self.assertEqual(err, "error: run thick-seed_1: another process is at it; wait for it\n")

    def test_arguments_that_exclude_each_other(self):
        for wrong in (["--list", "--slurm"], ["--collect-only", "--list"], ["--dry-run"], ["--slurm-options", "--time=1"],
                      ["--task", "1", "--slurm"], ["--parallel", "0"], ["--task", "0"]):
            _, err = self.sweep(*wrong, code=2)
            self.assertIn(wrong[0], err)


if __name__ == "__main__":
    unittest.main()
