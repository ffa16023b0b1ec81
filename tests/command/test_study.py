"""study: from a folder to a report that says what holds; killed, it goes on without repeating what is done."""

import os
import pathlib
import time
import unittest

from support import CASE, CommandTest

STUDY = """\
title = "A small study"
source = "nobody"
sections = ["speed"]
[quick.activity]
seeds = [1, 2]
[full.activity]
"time.end" = 0.2
"""

SWEEP = """\
title = "Activity"
case = "case.toml"
seeds = [1, 2, 3]
seed_keys = ["particles.seed"]
threads = 1
[grid]
"physics.activity.activity" = [0.05, 0.5]
[[quantity]]
series = "flow.v_rms"
"""

SECTION = '''\
from mesogen.figures import style
from mesogen.study import above

TITLE, FIGURE, SWEEPS = "Speed", "v rms", ["activity"]


def write(section):
    runs = section.runs("activity")
    slow, fast = (runs.where(physics__activity__activity=z).estimate("flow", "v_rms", 0.0) for z in (0.05, 0.5))
    page, (axes,) = style.tiles(1, 1, (2.0, 1.5))
    axes.plot([0.05, 0.5], [slow.mean, fast.mean])
    section.picture("speed", page, "Means.", ("zeta", "v_rms"), [(0.05, slow.mean), (0.5, fast.mean)])
    section.claim("More activity is faster.", above(fast, slow), f"{fast.text()} and {slow.text()} m/s")
    section.claim("Less activity is faster.", above(slow, fast), f"over {slow.count} seeds")
'''


class Study(CommandTest):
    def setUp(self):
        super().setUp()
        os.mkdir(self.path("small"))
        case = CASE.replace("spacing = 0.1", 'spacing = 0.1\narrangement = "jittered"\nseed = 1')
        for name, text in (("case.toml", case), ("study.toml", STUDY), ("activity.toml", SWEEP), ("speed.py", SECTION)):
            self.write_case(text, os.path.join("small", name))

    def study(self, *arguments, **more):
        return self.mesogen("study", "small", "--output", "out", *arguments, **more)

    def test_folder_of_somebody_else(self):
        os.makedirs(self.path("out", "bin"))
        for more in ([], ["--write-only"]):
            _, err = self.study(*more, code=2)
            self.assertEqual(err, "error: out is not empty and holds nothing of ours: choose another --output, such as a "
                                  "new folder in it\n")
        self.assertEqual(os.listdir(self.path("out")), ["bin"])

    def runs(self):
        return self.table("out", "activity", "runs.csv")

    def page(self):
        return self.read("out", "report", "index.html")

    def test_a_report_from_nothing(self):
        out, err = self.study("--quick")
        self.assertRegex(out, r"(?m)^ +holds  Speed: More activity is faster\. [\d.]+ ± ")
        self.assertRegex(out, r"(?m)^does not hold  Speed: Less activity is faster\. over 2 seeds$")
        self.assertIn("wrote out/report/index.html", out)
        self.assertIn("Activity: 4 runs", err)
        page = self.page()
        for words in ("A small study", "2 claims", "1 holds", "speed_speed.png", "speed_speed.csv", "quick",
                      "4, ", "[physics.activity]"):
            self.assertIn(words, page)
        with open(self.path("out", "report", "speed_speed.png"), "rb") as file:
            self.assertEqual(file.read(4), b"\x89PNG")
        slow, fast = self.table("out", "report", "speed_speed.csv")
        self.assertEqual((slow["zeta"], fast["zeta"]), ("0.05", "0.5"))
        self.assertGreater(float(fast["v_rms"]), 5.0 * float(slow["v_rms"]))

    def test_what_is_done_is_not_done_again(self):
        self.study("--quick")
        before = self.runs()
        self.study("--quick", "--quiet")
        self.assertEqual(self.runs(), before)
        self.study()  # a third seed; the others are the same
        self.assertEqual(self.runs()[:4], before)
        self.assertEqual(len(self.runs()), 6)
        self.study("--full")  # longer: all again
        self.assertEqual(len(self.runs()), 12)

    def test_killed_at_any_moment_it_goes_on(self):
        self.write_case(SWEEP.replace("[grid]", '[common]\n"time.end" = 1.0\n[grid]'), os.path.join("small", "activity.toml"))
        for wait in (0.8, 1.5):
            process = self.start("study", "small", "--output", "out", "--parallel", "1")
            time.sleep(wait)
            process.kill()
            process.wait()
        done = self.runs() if os.path.exists(self.path("out", "activity", "runs.csv")) else []
        self.study("--parallel", "1")
        self.assertEqual(self.runs()[: len(done)], done)
        self.assertEqual(len({run["label"] for run in self.runs()}), len(self.runs()))
        self.assertEqual(len(self.runs()), 6)

    def test_write_only_runs_nothing_and_says_what_is_missing(self):
        out, err = self.study("--write-only", "--quick", code=1)
        self.assertFalse(os.path.exists(self.path("out", "activity", "runs.csv")))
        self.assertIn("warning: activity: activity_0.05-seed_1: was not run", err)
        self.assertIn("warning: section speed is left out: there is no finished run of activity, physics.activity.activity = 0.05",
                      err)
        self.assertIn("0 claims", self.page())
        self.assertIn("Missing: activity: activity_0.05-seed_1: was not run", self.page())
        self.assertNotIn("--retry", err)

    def test_a_mistake_in_one_section_costs_no_other(self):
        self.write_case(SECTION.replace("fast.text()", "fast.txet()"), os.path.join("small", "bad.py"))
        self.write_case(STUDY.replace('["speed"]', '["bad", "speed"]'), os.path.join("small", "study.toml"))
        out, err = self.study("--quick", code=1)
        self.assertRegex(err, r"warning: section bad is left out: small/bad\.py:13: AttributeError: .*'txet'")
        self.assertIn("holds  Speed: More activity is faster.", out)
        self.assertIn("Missing: section bad is left out: small/bad.py:13", self.page())

    def test_a_section_is_told_what_there_is(self):
        for asked, words in (("physics__activty__activity=z", "no run of activity has 'physics.activty.activity'; did you mean "
                              "'physics.activity.activity'?"),
                             ("physics__activity__activity=z + 1", "there is no finished run of activity, physics.activity.activity "
                              "= 1.05; in those that there are physics.activity.activity is one of: 0.05, 0.5")):
            self.write_case(SECTION.replace("physics__activity__activity=z", asked), os.path.join("small", "speed.py"))
            self.assertIn(words, self.study("--quick", code=1)[1])
        self.write_case(SECTION.replace('"v_rms", 0.0', '"v_rms", 7.0'), os.path.join("small", "speed.py"))
        self.assertIn("'flow.v_rms' of activity, physics.activity.activity = 0.05 has no sample after 7 s; the last is at",
                      self.study("--quick", code=1)[1])

    def test_a_mistake_in_the_last_sweep_shows_before_the_first_run(self):
        self.write_case(SWEEP.replace("activity.activity", "activity.activty"), os.path.join("small", "other.toml"))
        self.write_case(SECTION.replace('["activity"]', '["activity", "other"]'), os.path.join("small", "speed.py"))
        self.assertIn("activty", self.study("--quick", code=2)[1])
        self.assertFalse(os.path.exists(self.path("out", "activity", "runs")))

    def test_a_change_that_points_make_again_is_refused(self):
        self.write_case(STUDY.replace("[quick.activity]", '[quick.activity]\n"physics.activity.activity" = 0.1'),
                        os.path.join("small", "study.toml"))
        self.assertIn("study.toml: quick.activity.physics.activity.activity: is without effect", self.study("--quick", code=2)[1])

    def test_the_folder_is_no_place_for_modules(self):
        self.write_case("raise SystemExit('mine')\n", "random.py")
        self.assertIn("was not run", self.study("--write-only", code=1)[1])

    def test_a_section_that_asks_for_what_no_run_has_is_left_out(self):
        self.write_case(SECTION.replace('"v_rms", 0.0', '"v_rsm", 0.0'), os.path.join("small", "speed.py"))
        _, err = self.study("--quick", code=1)
        self.assertRegex(err, r"warning: section speed is left out: .*no quantity 'v_rsm'")
        self.assertIn("0 claims", self.page())

    def test_a_section_alone_leaves_the_report(self):
        self.study("--write-only", code=1)
        report = pathlib.Path(self.path("out", "report"))
        (report / "index.html").write_text("of all sections", encoding="utf-8")
        out, _ = self.study("--write-only", "--only", "speed", code=1)
        self.assertIn("wrote out/report/speed.html", out)
        self.assertIn("A small study", (report / "speed.html").read_text(encoding="utf-8"))
        self.assertEqual(self.page(), "of all sections")

    def test_refusals(self):
        self.assertIn("error: nowhere: holds no study.toml; give the folder of a study, such as studies/paper",
                      self.mesogen("study", "nowhere", code=2)[1])
        self.assertIn("has no section 'spead'; did you mean 'speed'?", self.study("--only", "spead", code=2)[1])
        self.write_case(SWEEP.replace("activity.activity", "activity.activty"), os.path.join("small", "activity.toml"))
        self.assertIn("activty", self.study(code=2)[1])
        self.assertIn("--quick excludes --full: give one of them", self.study("--quick", "--full", code=2)[1])


if __name__ == "__main__":
    unittest.main()
