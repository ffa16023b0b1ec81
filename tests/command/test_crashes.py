"""Plugins that end the process: who it was is told, nothing is lost, and what is resumed goes on as if unbroken."""

import os
import re
import signal
import subprocess
import unittest

import h5py
import numpy
from support import BROKEN_PLUGINS, CASE, MESOGEN, CommandTest

FOLDER = os.path.join(BROKEN_PLUGINS, "crashing")
# A sanitizer reports most crashes itself, in its own words and with its own exit status.
SANITIZED = bool(os.environ.get("SANITIZED"))
EXIT = "ended the process: it called exit(); throw an error instead"
LATE = "did not come back in time, as in a loop without end (SIGALRM)"
BY = {
    "null": (signal.SIGSEGV, "crashed: it used memory that is not there, such as through a null pointer (SIGSEGV)"),
    "overflow": (signal.SIGSEGV, "crashed: its stack overflowed, as in a recursion without end (SIGSEGV)"),
    "division": (signal.SIGFPE, "crashed: it divided an integer by zero (SIGFPE)"),
    "illegal": (signal.SIGILL, "crashed: it ran an instruction that this processor does not have (SIGILL)"),
    "abort": (signal.SIGABRT, "crashed: it aborted, as after a failed assertion or an exception nobody caught (SIGABRT)"),
    "bus": (signal.SIGBUS, "crashed: it used memory that cannot be had (SIGBUS)"),
}
OUTPUT = "[output]\ncheckpoint_interval = 1e-9"
WATCH = '[observers.watch]\ntype = "crashing"\nevery = 1\n'
WITH_OBSERVER = CASE.replace("[output]", WATCH + OUTPUT)
WITH_FORCE = CASE.replace("[output]", '[physics.bad]\ntype = "crashing"\n' + OUTPUT)
LATER = WITH_FORCE.replace('"crashing"\n', '"crashing"\nafter = 0.06\n')
MOMENT = r"at step \d+, t = [-+0-9.e]+ s"


class CrashTest(CommandTest):
    def crashes(self, call, *arguments, by="null", **environment):
        """What the command writes to stderr where a plugin crashes in this call."""
        done = subprocess.run([MESOGEN, *arguments, "--plugin-path", FOLDER], cwd=self.folder, text=True, check=False,
                              env=self.environment(CRASH_IN=call, CRASH_BY=by, **environment), capture_output=True,
                              timeout=300)
        status = 1 if by == "exit" else -BY[by][0]
        self.assertTrue(done.returncode == status or (SANITIZED and done.returncode != 0), (done.returncode, done.stderr))
        return done.stderr

    def assert_told(self, err, who, how=BY["null"][1]):
        how = "(crashed|ended).*" if SANITIZED else re.escape(how)
        self.assertRegex(err, rf"(?m)^error: {who} {how}$")

    def results(self, folder):
        """All that a run recorded."""
        with h5py.File(self.path(folder, "results.h5"), "r") as file:
            found = {}
            for group in ("observables", "particles"):
                file[group].visititems(lambda name, item: found.update({name: numpy.asarray(item)})
                                       if isinstance(item, h5py.Dataset) else None)
            return found

    def assert_same_bits(self, one, other):
        expected, found = self.results(one), self.results(other)
        self.assertEqual(list(expected), list(found))
        for name, values in expected.items():
            self.assertTrue(numpy.array_equal(values, found[name], equal_nan=values.dtype.kind == "f"), name)


class InARun(CrashTest):
    """The line that is written last, and what stays."""

    def test_every_way_to_crash(self):
        case = self.write_case(LATER)
        who = rf'physics\.bad \(plugin "crashing"\), pass "work" {MOMENT}'
        for by, (_, how) in {**BY, "exit": (None, EXIT)}.items():
            with self.subTest(by):
                err = self.crashes("pass", "run", case, "--output", by, by=by)
                self.assert_told(err, who, how)
                # After that line comes how to go on, and nothing else.
                self.assertRegex(err, r"\n  the checkpoint of step \d+, t = 0\.0[56]\d* s is kept: once the plugin is mended, "
                                      rf"`mesogen resume {by}` goes on from there\n$")
                self.mesogen("resume", by, "--plugin-path", FOLDER, "--quiet")
        self.mesogen("run", case, "--output", "unbroken", "--plugin-path", FOLDER, "--quiet")
        for by in (*BY, "exit"):
            self.assert_same_bits("unbroken", by)

    def test_threads_of_a_loop(self):
        case = self.write_case(LATER)
        who = rf'physics\.bad \(plugin "crashing"\), pass "work" {MOMENT}'
        for by in ("null", "overflow"):
            err = self.crashes("particle", "run", case, "--output", by, "--threads", "3", by=by)
            self.assert_told(err, who, BY[by][1])
            self.assertEqual(len(re.findall("(?m)^error: ", err)), 1, err)

    def test_calls_of_an_observer(self):
        case = self.write_case(WITH_OBSERVER)
        for call in ("start()", "follow()", "sample()", "save()"):
            with self.subTest(call):
                err = self.crashes(call, "run", case, "--output", call[:-2])
                self.assert_told(err, rf'observers\.watch \(plugin "crashing"\), {re.escape(call)} {MOMENT}')
                advice = (r"the checkpoint of step 0, t = 0 s is kept: once the plugin is mended, `mesogen resume follow` "
                          "goes on from there" if call == "follow()" else
                          rf"no checkpoint was written yet: `mesogen resume {call[:-2]}` starts again from the beginning")
                self.assertIn(f"\n  {advice}\n", err)
                # `follow()` is planned only where it crashes.
                self.mesogen("resume", call[:-2], "--plugin-path", FOLDER, "--quiet")

    def test_a_boundary_within_an_observer(self):
        case = self.write_case(CASE.replace("periodic_ghosts", "crashing"))
        # In a flow on a mesh a particle leaves the box long before particles are sorted: an observer asks for it first.
        self.assert_told(self.crashes("keep_inside()", "run", case, "--output", "out", "--set",
                                      "physics.flow.type=incompressible", "--set", "velocity.type=uniform", "--set",
                                      "velocity.value=[1.0, 0.0]", "--set", "time.step=0.02", "--set",
                                      "observers.flow.type=defects", "--set", "observers.flow.interval=0.02",
                                      "--set", "output.interval=0.1"),
                         rf'observers\.flow \(plugin "defects"\), sample\(\) {MOMENT}: plugin "crashing", '
                         r"keep_inside\(\)")
        self.assert_told(self.crashes("ghost_rule()", "run", case, "--output", "rule"),
                         rf'plugin "crashing", ghost_rule\(\) {MOMENT}')

    def test_resume_replay_and_rehearsal(self):
        case = self.write_case(WITH_OBSERVER)
        who = r'observers\.watch \(plugin "crashing"\), {} ' + MOMENT
        self.mesogen("run", case, "--output", "out", "--plugin-path", FOLDER, "--quiet")
        err = self.crashes("restore()", "resume", "out", "--set", "time.end=0.2")
        self.assert_told(err, who.format(r"restore\(\)"))
        self.assertRegex(err, r"\n  the checkpoint of step \d+, t = 0\.1 s is kept: .*`mesogen resume out` goes on from there\n$")
        self.assert_told(self.crashes("sample()", "replay", "out"), who.format(r"sample\(\)"))
        self.assert_told(self.crashes("sample()", "check", case), who.format(r"sample\(\)"))


class BeforeARun(CrashTest):
    def test_every_call_that_puts_a_case_together(self):
        force = self.write_case(WITH_FORCE)
        for call in ("constructor", "parameters()", "publish()", "declare()", "advice", "numbers", "destructor"):
            with self.subTest(call):
                self.assert_told(self.crashes(call, "check", force, "--quick"), f'plugin "crashing", {re.escape(call)}')
        watch = self.write_case(WITH_OBSERVER)
        for call in ("constructor", "parameters()", "plan()", "destructor"):
            self.assert_told(self.crashes(call, "check", watch, "--quick"), f'plugin "crashing", {re.escape(call)}')
        kernel = self.write_case(CASE.replace("quintic", "crashing"))
        self.assert_told(self.crashes("shape()", "check", kernel, "--quick"), r'plugin "crashing", shape\(\)')
        boundary = self.write_case(CASE.replace("periodic_ghosts", "crashing"))
        self.assert_told(self.crashes("continuation()", "run", boundary), r'plugin "crashing", continuation\(\)')

    def test_what_tells_of_plugins(self):
        self.assert_told(self.crashes("loading", "plugin", "list"), r'plugin "\S*/crashing_physics\.so", loading')
        self.assert_told(self.crashes("parameters()", "plugin", "info", "crashing"), r'plugin "crashing", parameters\(\)')


class Natural(CrashTest):
    """An observer that remembers where it started, and saves nothing."""

    def test_a_resumed_run_begins_where_it_did(self):
        case = self.write_case(LATER.replace("[output]", WATCH + "[output]"))
        self.mesogen("run", case, "--output", "unbroken", "--plugin-path", FOLDER, "--quiet")
        self.crashes("pass", "run", case, "--output", "out")
        self.mesogen("resume", "out", "--plugin-path", FOLDER, "--quiet")
        moved = self.results("out")["watch/moved/value"]
        self.assertNotEqual(moved[-1], 0.0)
        self.assertTrue(numpy.array_equal(moved, self.results("unbroken")["watch/moved/value"]))


class PluginCheck(CrashTest):
    """A crash breaks one check and hides no other."""

    def check(self, kind, call="", by="null", code=1, more=()):
        out, err = self.mesogen("plugin", "check", os.path.join(FOLDER, f"crashing_{kind}.so"), *more, code=code,
                                CRASH_IN=call, CRASH_BY=by)
        if not SANITIZED:
            self.assertEqual(err, "")
        lines = out.splitlines()
        self.assertTrue(lines[0].startswith(f"{kind} crashing 1.0.0: "), out)
        failed = dict(line[10:].split(": ", 1) for line in lines if line.startswith("  FAILED"))
        held = [line[10:] for line in lines if line.startswith("  ok")]
        self.assertEqual(code == 1, f"crashing is not fit for use: {len(failed)} of its checks failed" in out, out)
        return failed, held

    def assert_fails(self, failed, what, text):
        self.assertIn(what, failed)
        self.assertTrue(SANITIZED or failed[what] == text, failed[what])

    def test_a_plugin_that_does_not_crash(self):
        for kind in ("kernel", "boundary", "physics", "observer"):
            with self.subTest(kind):
                failed, held = self.check(kind, code=0)
                self.assertEqual(failed, {})
                self.assertGreaterEqual(len(held), 6)

    def test_each_check_by_itself(self):
        whole = self.check("observer", code=0)[1]
        failed, held = self.check("observer", "restore()")
        what = "a resumed run records the same as an unbroken one"
        self.assertEqual(held, [check for check in whole if check != what])
        self.assert_fails(failed, what, 'observers.tested (plugin "crashing"), restore() at step 2, t = 0.002 s '
                                        + BY["null"][1])
        failed, held = self.check("observer", "sample()")
        self.assertEqual(held, whole[:4])
        self.assertEqual(list(failed), whole[4:])

    def test_every_way_to_crash(self):
        whole = self.check("physics", code=0)[1]
        touched = "passes touch only what they declared, and make finite numbers"
        ways = {**{by: how for by, (_, how) in BY.items()}, "exit": EXIT}
        for by, how in ways.items():
            with self.subTest(by):
                failed, held = self.check("physics", "pass", by)
                self.assertEqual(sorted([*failed, *held]), sorted(whole))
                self.assert_fails(failed, touched, f'physics.tested (plugin "crashing"), pass "work" at step 0, t = 0 s {how}')
        failed, _ = self.check("physics", "pass", "_exit")
        self.assert_fails(failed, touched, "it ended the process, with exit status 0; throw an error instead")
        failed, _ = self.check("physics", "particle")
        self.assertEqual(len(failed), 4)

    def test_a_loop_without_end(self):
        failed, held = self.check("kernel", "shape()", "loop", more=("--time-limit", "1"))
        self.assertGreaterEqual(len(held), 3)
        self.assert_fails(failed, "its shape can be used", f'plugin "crashing", shape() {LATE}')

    def test_what_no_check_can_do_without(self):
        failed, held = self.check("physics", "parameters()")
        self.assertEqual((list(failed), held), (["it can be made, and names its parameters"], []))
        failed, held = self.check("physics", "declare()")
        self.assert_fails(failed, "it can be put into a scene", 'plugin "crashing", declare() ' + BY["null"][1])
        self.assertIn("its descriptor has a version and a summary", held)
        failed, _ = self.check("physics", "destructor")
        self.assert_fails(failed, "it can be made, and names its parameters",
                          'plugin "crashing", destructor ' + BY["null"][1])


if __name__ == "__main__":
    unittest.main()
