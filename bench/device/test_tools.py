#!/usr/bin/python3
"""Stages whose tools are missing, or find something: each tool is played by a small script."""

import json
import os
import sys
import unittest
from unittest import mock

from test_support import DEVICE, InFolder

import agreement
import counters
import look
import operations
import place
import programs
import roofline
import speed_stages
from verdicts import FAIL, PASS, NotRun, Report, read_report


class Missing(InFolder):
    def report(self):
        return Report("a", self.folder / "a.jsonl")

    def test_a_missing_tool_is_named(self):
        with mock.patch.dict(os.environ, {"PATH": str(self.folder)}, clear=True), \
                mock.patch("place.glob.glob", return_value=[]):
            for stage, tool in ((programs.sanitizer("memcheck"), "compute-sanitizer"), (counters.counters, "ncu")):
                with self.assertRaisesRegex(NotRun, f"{tool} is neither in PATH nor in /usr/local/cuda.*: install"):
                    stage(None, self.folder, self.report())

    def test_a_tool_of_the_toolkit_is_found(self):
        tool = self.write("", "bin", "ncu")
        tool.chmod(0o755)
        with mock.patch.dict(os.environ, {"PATH": "", "CUDA_HOME": str(self.folder)}):
            self.assertEqual(place.find_tool("ncu"), str(tool))

    def test_missing_python_modules(self):
        with mock.patch.dict(sys.modules, {"h5py": None}):
            for stage in (agreement.agreement, programs.command_tests):
                with self.assertRaisesRegex(NotRun, "has no h5py, which reading results needs: install numpy and h5py, "
                                                    "or name another Python by MESOGEN_PYTHON"):
                    stage(None, self.folder, self.report())

    def test_a_library_that_the_kit_has_no_room_for(self):
        kit = mock.Mock(kit={"left_out": ["libcufft.so.99"]})
        kit.program.return_value = self.write("#!/bin/sh\necho '{\"problem\": \"none\"}'; exit 77\n", "p")
        kit.program.return_value.chmod(0o755)
        with mock.patch.dict(os.environ, {"LD_LIBRARY_PATH": ""}):
            look.look(kit, self.folder, self.report())
            lines, _ = read_report(self.folder / "a.jsonl")
            self.assertEqual([line.verdict for line in lines], [FAIL, FAIL])
            self.assertIn("libcufft.so.99 is missing: the kit has no room for it, and it is neither in a CUDA toolkit "
                          "of this machine (/usr/local/cuda*, CUDA_HOME) nor in LD_LIBRARY_PATH. Install",
                          lines[0].detail)
            self.write("", "lib64", "libcufft.so.99")
            with mock.patch.dict(os.environ, {"CUDA_HOME": str(self.folder), "LD_LIBRARY_PATH": "/mine"}):
                self.assertEqual(place.add_libraries_of_this_machine(kit.kit), [])
                self.assertEqual(os.environ["LD_LIBRARY_PATH"], f"/mine:{self.folder / 'lib64'}")

    def test_what_the_device_is(self):
        told = {"emulated": False, "compute_capability": "9.0", "driver_cuda": 13010, "runtime_cuda": 13000,
                "memory_total_bytes": 2e9, "to_device_bytes_per_second": 5.5e10, "from_device_bytes_per_second": 5e10,
                "launch_us": 2.0, "launch_and_wait_us": 6.5, "step_of_30_kernels_us": 80.0,
                "step_of_30_kernels_in_a_graph_us": 90.4, "step_of_30_kernels_in_an_unchanged_graph_us": 60.0, **DEVICE}
        here = mock.Mock(kit=None)
        here.program.return_value = self.write(f"#!/bin/sh\necho '{json.dumps(told)}'\n", "p")
        here.program.return_value.chmod(0o755)
        look.look(here, self.folder, self.report())
        lines, _ = read_report(self.folder / "a.jsonl")
        self.assertEqual([(line.what, line.verdict, line.detail) for line in lines], [
            ("the device", PASS, "a card, compute capability 9.0, a driver for CUDA 13.1, built with 13.0, 1.0 of 2.0 "
                                 "GB free"),
            ("copies", PASS, "55 GB/s to the device, 50 GB/s from it, 4,000 GB/s read and written on it"),
            ("starts of kernels", PASS, "2.00 us each in a row, 6.50 us with a wait"),
            ("30 kernels and a wait", PASS, "80 us started one by one, 90 us in a CUDA graph that is brought up to "
                                            "date, 60 us in one that is not")])
        self.assertEqual(look.seen(self.folder), told)

    def test_too_little_memory_on_the_device(self):
        self.write(json.dumps(DEVICE), "look.json")
        with self.assertRaisesRegex(NotRun, "100,000,000 particles need some 37 GB of the device, which has 1 GB free"):
            speed_stages.need_memory(self.folder, 10000)
        speed_stages.need_memory(self.folder, 1000)


class Tools(InFolder):
    """compute-sanitizer and ncu, each played by a small script, as on a machine with a device."""

    def setUp(self):
        super().setUp()
        for module in ("programs", "counters", "roofline"):
            patch = mock.patch(f"{module}.EMULATED", False)
            patch.start()
            self.addCleanup(patch.stop)
        path = mock.patch.dict(os.environ, {"PATH": f"{self.folder}:/usr/bin:/bin"})
        path.start()
        self.addCleanup(path.stop)
        self.report = Report("a", self.folder / "a.jsonl")
        self.place = mock.Mock(mesogen="mesogen", kit=None)
        self.place.watched = lambda name: (name, {})

    def tool(self, name, script):
        self.write("#!/bin/bash\n" + script, name).chmod(0o755)

    def lines(self):
        return [(line.what, line.verdict, line.detail) for line in read_report(self.report.file)[0]]

    def test_a_sanitizer_that_finds_nothing(self):
        self.tool("compute-sanitizer", 'echo "$@" >> "$0.told"; echo "========= ERROR SUMMARY: 0 errors"')
        programs.sanitizer("initcheck")(self.place, self.folder, self.report)
        self.assertEqual(self.lines(), [("pair sums", PASS, "initcheck found no error"),
                                        ("20 steps", PASS, "initcheck found no error")])
        passes, steps = (self.folder / "compute-sanitizer.told").read_text(encoding="utf-8").splitlines()
        self.assertEqual(passes, "--tool initcheck --error-exitcode 86 --target-processes all device_passes")
        self.assertIn("mesogen run case.toml", steps)
        self.assertIn("run.device=cuda", steps)

    def test_a_sanitizer_that_finds_an_error(self):
        self.tool("compute-sanitizer", 'echo "========= Invalid __global__ read of size 4 bytes"\n'
                                       'echo "========= ERROR SUMMARY: 3 errors"; exit 86')
        programs.sanitizer("memcheck")(self.place, self.folder, self.report)
        self.assertEqual(self.lines()[0],
                         ("pair sums", FAIL, "exit code 86, 3 errors: Invalid __global__ read of size 4 bytes"))

    def test_a_sanitizer_that_does_not_start(self):
        self.tool("compute-sanitizer", 'echo "no such option"; exit 1')
        programs.sanitizer("memcheck")(self.place, self.folder, self.report)
        self.assertEqual(self.lines()[1],
                         ("20 steps", FAIL, "exit code 1, an unknown number of errors: no such option"))

    def test_counters_are_read(self):
        self.tool("ncu", 'echo \'"ID","gpu__time_duration.sum","launch__registers_per_thread"\'\n'
                         'echo \'"","us","register/thread"\'\necho \'"0","41.2","64"\'\n')
        counters.counters(self.place, self.folder, self.report)
        self.assertEqual(self.lines()[0], ("volume", PASS, "time 41.2 us, registers 64 register/thread"))
        self.assertEqual(len(self.lines()), 3)

    def test_counters_that_only_root_may_read(self):
        self.tool("ncu", "echo '==ERROR== ERR_NVGPUCTRPERM - The user does not have permission'; exit 1")
        with self.assertRaisesRegex(NotRun, r"this user may not read the counters of the device \(ERR_NVGPUCTRPERM\): "
                                            "run this as root, or load the driver with "
                                            "NVreg_RestrictProfilingToAdminUsers=0"):
            counters.counters(self.place, self.folder, self.report)

    def test_counters_of_no_kernel(self):
        self.tool("ncu", "echo '==WARNING== No kernels were profiled.'")
        counters.counters(self.place, self.folder, self.report)
        self.assertEqual(self.lines()[0],
                         ("volume", FAIL, "ncu told nothing of kernels named VolumePass (exit code 0)"))

    def test_shares_of_the_roofline(self):
        self.write(json.dumps(DEVICE), "look.json")
        with self.assertRaisesRegex(NotRun, "the stages `speed` and `large`, which measure the parts of a step, gave "
                                            "no times"):
            self.with_operations()
        self.write(json.dumps({"framework: volume": 1e-4}), "shares_500.json")
        self.with_operations()
        # 250,000 particles x 48 neighbours x 40 operations at 60 Tflop/s.
        self.assertEqual(self.lines(), [("250,000 particles, volume", PASS,
                                         "8 % of the roofline: 0.1 ms, 0.008 ms by arithmetic")])
        self.assertEqual(read_report(self.report.file)[1][2],
                         ["device roofline", "volume", "% of the roofline, 250,000 particles", mock.ANY])

    def with_operations(self):
        counted = {name: {"neighbours": 48.0, "operations_a_pair": 40.0} for name, _ in roofline.PASSES.values()}
        with mock.patch("roofline.read_operations", return_value=counted):
            roofline.roofline(self.place, self.folder, self.report)

    def test_what_counts_operations_was_not_built(self):
        self.place.program.return_value = self.folder / "passes-x86-64-v4"
        with mock.patch("operations.instruction_set", return_value="x86-64-v4"):
            with self.assertRaisesRegex(NotRun, "passes-x86-64-v4, which counts operations, was not built: build it "
                                                "by"):
                operations.count_operations(self.place)


if __name__ == "__main__":
    unittest.main()
