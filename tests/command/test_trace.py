"""run --trace: where the time went, as a trace that Perfetto and chrome://tracing read."""

import filecmp
import json
import os
import signal
import unittest

from support import CASE, CommandTest


class TraceOption(CommandTest):
    def events(self, file="trace.json"):
        with open(self.path(file), encoding="utf-8") as text:
            return [event for event in json.load(text)["traceEvents"] if event["ph"] == "X"]

    def expect_nested(self, events):
        """By their start, each within the one around it or behind it."""
        rounding = 0.0011  # microseconds: they are written with three digits
        open_until = []
        for event in events:
            self.assertGreaterEqual(event["dur"], 0.0)
            while open_until and event["ts"] >= open_until[-1] - rounding:
                open_until.pop()
            end = event["ts"] + event["dur"]
            if open_until:
                self.assertLessEqual(end, open_until[-1] + rounding, event)
            open_until.append(end)
        self.assertEqual([event["ts"] for event in events], sorted(event["ts"] for event in events))

    def test_everything_that_a_run_does_is_in_it(self):
        _, err = self.mesogen("run", self.write_case(), "--output", "out", "--trace", "trace.json")
        events = self.events()
        self.expect_nested(events)
        self.assertIn(f"trace: trace.json, {len(events)} events", err)
        names = {event["name"]: event["cat"] for event in events}
        for name, category in (("physics.activity: active stress", "plugin"), ("framework: volume", "framework"),
                               ("framework: values beyond the faces", "framework"),
                               ("framework: integration", "framework"), ("framework: neighbours, sorting", "framework"),
                               ("observers.flow: sample", "plugin"), ("output: frame", "output"),
                               ("output: checkpoint", "output")):
            self.assertEqual(names.get(name), category, f"{name} in {sorted(names)}")
        steps = [event for event in events if event["name"] == "framework: step"]
        self.assertEqual([step["args"]["run"] for step in steps], list(range(1, len(steps) + 1)))
        self.assertIn(f"{len(steps)} steps in", err)

    def test_passes_lie_within_steps(self):
        self.mesogen("run", self.write_case(), "--output", "out", "--trace", "trace.json")
        events = self.events()
        steps = [event for event in events if event["name"] == "framework: step"]
        after = [event for event in events
                 if event["name"] == "physics.activity: active stress" and event["ts"] > steps[0]["ts"]]
        self.assertEqual(len(after), len(steps))
        for step, event in zip(steps, after):
            self.assertTrue(step["ts"] <= event["ts"] <= step["ts"] + step["dur"])

    def test_results_are_the_same_bits(self):
        case = self.write_case()
        self.mesogen("run", case, "--output", "plain")
        self.mesogen("run", case, "--output", "traced", "--trace", "trace.json")
        files = [self.path(folder, "checkpoint_a.h5") for folder in ("plain", "traced")]
        self.assertTrue(filecmp.cmp(*files, shallow=False))

    def test_the_folder_of_the_run_may_hold_it_and_it_replaces_a_trace(self):
        case = self.write_case()
        self.mesogen("run", case, "--output", "out", "--trace", "out/trace.json")
        first = len(self.events("out/trace.json"))
        self.mesogen("run", case, "--output", "out", "--overwrite", "--trace", "out/trace.json",
                     "--set", "time.end=0.05")
        self.assertTrue(0 < len(self.events("out/trace.json")) < first)

    def test_an_interrupted_run_and_its_resumption(self):
        case = self.write_case(CASE.replace("end = 0.1", "end = 1.0"))
        process = self.start("run", case, "--output", "out", "--trace", "first.json")
        self.wait_for(process, "out", "checkpoint_a.h5")
        self.assertEqual(self.events("first.json"), [])  # valid already
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, err)
        self.expect_nested(self.events("first.json"))
        self.mesogen("resume", "out", "--trace", "second.json")
        steps = [[event["args"]["run"] for event in self.events(file) if event["name"] == "framework: step"]
                 for file in ("first.json", "second.json")]
        self.assertEqual(sum(steps, []), list(range(1, len(steps[0]) + len(steps[1]) + 1)))

    def test_a_run_that_fails(self):
        self.mesogen("run", self.write_case(), "--output", "out", "--trace", "trace.json", "--set", "time.step=1.0",
                     "--set", "time.end=10.0", code=1)
        self.assertIn("framework: guard", [event["name"] for event in self.events()])


class WrongFiles(CommandTest):
    def refused(self, file, expected):
        _, err = self.mesogen("run", self.write_case(), "--output", "out", "--trace", file, code=2)
        self.assertIn(expected, err)
        self.assertFalse(os.path.exists(self.path("out")), "the run began")

    def test_no_folder_for_it(self):
        self.refused("no/trace.json", f"--trace no/trace.json: there is no folder {self.path('no')}: make it first, or "
                                      "choose another file")

    def test_a_folder(self):
        os.mkdir(self.path("here"))
        self.refused("here", "--trace here is a folder: name a file in it")

    def test_what_is_no_trace_is_kept(self):
        with open(self.path("notes.json"), "w", encoding="utf-8") as file:
            file.write('{"mine": 1}')
        self.refused("notes.json", "--trace notes.json is there already and is no trace: choose another file")
        with open(self.path("notes.json"), encoding="utf-8") as file:
            self.assertEqual(file.read(), '{"mine": 1}')

    def test_files_of_a_run_are_kept(self):
        self.mesogen("run", self.write_case(), "--output", "before")
        self.refused("before/results.h5", "--trace before/results.h5 belongs to a run: choose another file")


if __name__ == "__main__":
    unittest.main()
