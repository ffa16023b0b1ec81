#!/usr/bin/python3
"""Verdicts of stages that pass, fail, crash, hang or say nothing; what is said where nothing can begin."""

import os
import pathlib
import subprocess
import sys
import time
import unittest
from unittest import mock

from test_support import PLACES, InFolder

import libraries
import pack
import place
import runner
from speed_tables import row
from verdicts import FAIL, NOT_RUN, PASS, Line, Report, exit_code, read_report


class Stages(InFolder):
    """Each stage is a small Python program here."""

    def run_stages(self, programs_of, seconds=30.0, limit=60.0):
        heading = f"import os, sys, time\nsys.path[:0] = {PLACES!r}\nfrom pathlib import Path\nfrom verdicts import *\n"

        def command(name):
            own = f"report = Report({name!r}, Path({str(self.folder / 'parts')!r}) / '{name}.jsonl')\n"
            return [sys.executable, "-B", "-c", heading + own + programs_of[name]]

        return runner.run_stages([(name, seconds) for name in programs_of], command, self.folder, limit)[0]

    def test_a_stage_that_passes(self):
        lines = self.run_stages({"good": "report.judge('a sum', True, 'right', error=0.0)"})
        self.assertEqual(lines, [Line("good", "a sum", PASS, "right", {"error": 0.0})])
        self.assertEqual(exit_code(lines), 0)

    def test_one_that_fails_does_not_stop_the_next(self):
        lines = self.run_stages({"bad": "report.judge('a sum', False, 'wrong')", "good": "report.judge('b', True)"})
        self.assertEqual([line.verdict for line in lines], [FAIL, PASS])
        self.assertEqual(exit_code(lines), 1)

    def test_one_that_crashes_fails(self):
        lines = self.run_stages({"crash": "report.judge('a', True)\nprint('a word', flush=True)\nos.abort()",
                                 "exits": "report.judge('a', True)\nsys.exit(5)"})
        self.assertEqual([(line.what, line.verdict) for line in lines],
                         [("a", PASS), ("end", FAIL), ("a", PASS), ("end", FAIL)])
        self.assertEqual(lines[1].detail, "the stage ended with signal SIGABRT; the reason is in crash.log")
        self.assertEqual(lines[3].detail, "the stage ended with exit code 5; the reason is in exits.log")
        self.assertIn("a word", (self.folder / "crash.log").read_text(encoding="utf-8"))

    def test_one_that_says_nothing_fails(self):
        lines = self.run_stages({"silent": "pass"})
        self.assertEqual(lines[0][1:4], ("end", FAIL, "the stage gave no verdict; what it did is in silent.log"))

    def test_one_that_hangs_is_killed_with_all_that_it_started(self):
        program = (f"report.judge('a', True)\nif os.fork() == 0:\n  time.sleep(3)\n"
                   f"  open({str(self.folder / 'alive')!r}, 'w')\n  os._exit(0)\ntime.sleep(60)")
        begin = time.monotonic()
        lines = self.run_stages({"hangs": program, "good": "report.judge('b', True)"}, seconds=1.5)
        self.assertLess(time.monotonic() - begin, 20.0)
        self.assertEqual([(line.stage, line.verdict) for line in lines],
                         [("hangs", PASS), ("hangs", FAIL), ("good", PASS)])
        self.assertEqual(lines[1].detail, "killed after 2 s; what it did is in hangs.log")
        time.sleep(max(0.0, 4.0 - (time.monotonic() - begin)))
        self.assertFalse((self.folder / "alive").exists())

    def test_where_no_time_is_left(self):
        lines = self.run_stages({"late": "report.judge('a', True)"}, limit=1.0)
        self.assertEqual(lines[0].verdict, NOT_RUN)
        self.assertEqual(lines[0].detail,
                         "no time was left of the 1 s for all stages; `--only late` runs this stage alone")

    def test_a_line_that_is_cut_off_is_left_out(self):
        report = Report("a", self.folder / "a.jsonl")
        report.judge("b", True)
        report.figures(row("device", "1", {"ms": 2.0}))
        with open(report.file, "a", encoding="utf-8") as file:
            file.write('{"line": ["a", "c"')
        self.assertEqual(read_report(report.file), ([Line("a", "b", PASS, "", {})], [["device", "1", "ms", 2.0]]))


class Beginning(InFolder):
    def script(self, *arguments, **environment):
        """Exit code and error text of scripts/device."""
        done = subprocess.run([place.PROJECT / "scripts/device", *arguments], env={**os.environ, **environment},
                              text=True, capture_output=True, check=False)
        return done.returncode, done.stderr

    def test_the_script_says_why_it_cannot_begin(self):
        code, text = self.script("--build", self.folder, self.folder / "out")
        self.assertEqual(code, 2)
        self.assertRegex(text, r"^scripts/device: there is no \S+/bin/mesogen: build it by ")
        self.assertFalse((self.folder / "out").exists())
        code, text = self.script()
        self.assertEqual(code, 2)
        self.assertIn("give either OUT, a folder for the results, or --pack KIT", text)

    def test_no_python(self):
        self.assertEqual(self.script("out", MESOGEN_PYTHON="/bin/false"), (
            2, "scripts/device: needs Python 3.9 or later, and this is none: /bin/false; MESOGEN_PYTHON may name "
               "one\n"))

    def test_no_build(self):
        with self.assertRaisesRegex(place.Unusable, "there is no .*/bin/mesogen: build it by `MESOGEN_CUDA=on "
                                                    "scripts/setup all`, or name another build folder by --build"):
            place.Place(self.folder).check()

    def test_no_code_for_cuda(self):
        self.write("", "bin", "mesogen")
        with self.assertRaisesRegex(place.Unusable, r"has no code for CUDA \(.*libmesogen_cuda.so is missing\): build "
                                                    r"it by"):
            place.Place(self.folder).check()

    def test_a_kit_for_a_newer_machine(self):
        self.write("#!/bin/sh\necho 'version GLIBC_2.99 not found' >&2\nexit 1\n", "bin", "mesogen").chmod(0o755)
        self.write("", "lib", "libmesogen_cuda.so")
        here = place.Place(self.folder)
        here.kit = {"libc": "glibc 2.99"}
        with self.assertRaisesRegex(place.Unusable, "does not start here:\nversion GLIBC_2.99 not found\nThe kit "
                                                    "holds neither glibc nor libstdc.*It was packed with glibc 2.99, "
                                                    "and needs a"):
            here.check()


class Packing(InFolder):
    def test_a_kit_that_is_too_large(self):
        self.write("x" * 3000000, "lib", "large.so")
        with self.assertRaisesRegex(place.Unusable, r"the kit is 50\.0 MiB as tar\.gz, and may be 40\. Its largest "
                                                    r"files: lib/large\.so \(2\.9 MiB\)"):
            pack.check_size(50 << 20, self.folder)
        pack.check_size(40 << 20, self.folder)

    def test_a_program_finds_the_libraries_of_its_kit_first(self):
        wrapper = self.write(pack.WRAPPER, "kit", "bin", "program")
        self.write('#!/bin/sh\necho "$LD_LIBRARY_PATH $*"\n', "kit", "programs", "program").chmod(0o755)
        wrapper.chmod(0o755)
        own = self.folder.resolve() / "kit/lib"
        for before, expected in (({}, f"{own} a b\n"),
                                 ({"LD_LIBRARY_PATH": "/mine:/yours"}, f"{own}:/mine:/yours a b\n")):
            told = subprocess.run([wrapper, "a", "b"], env={"PATH": "/usr/bin:/bin", **before}, capture_output=True,
                                  text=True, check=True).stdout
            self.assertEqual(told, expected)
        kit = place.Place(self.folder)
        kit.kit, kit.build = {}, pathlib.Path("/kit")
        with mock.patch.dict(os.environ, {"LD_LIBRARY_PATH": "/mine"}):
            self.assertEqual(kit.watched("p"), (pathlib.Path("/kit/programs/p"), {"LD_LIBRARY_PATH": "/kit/lib:/mine"}))

    def test_a_build_that_is_not_complete(self):
        with self.assertRaisesRegex(place.Unusable, "cannot be installed: build all of it by `MESOGEN_CUDA=on "
                                                    "scripts/setup all`.\n.*cmake_install.cmake"):
            pack.install(mock.Mock(build=self.folder), ["--prefix", self.folder / "prefix"])

    def test_a_kit_packs_no_kit(self):
        with self.assertRaisesRegex(place.Unusable, "this is a kit: a kit is packed in a checkout, by `scripts/device "
                                                    "--pack KIT`"):
            pack.pack(mock.Mock(kit={}), self.folder / "kit")

    def needs(self, text):
        return mock.patch("libraries.subprocess.run", return_value=mock.Mock(stdout=text))

    def test_libraries_of_every_machine_stay(self):
        mine, large = self.write("", "usr", "libhdf5.so.103"), self.write("", "usr", "libhuge.so.1")
        os.truncate(large, 50 << 20)
        program = self.write("opens libcufft.so.12 by name", "programs", "p")
        text = (f"\tlinux-vdso.so.1 (0x1)\n"
                f"\tlibhdf5.so.103 => {mine} (0x2)\n"
                f"\tlibc.so.6 => /lib/libc.so.6 (0x3)\n"
                f"\tlibhuge.so.1 => {large} (0x4)\n"
                f"\tlibstdc++.so.6 => /lib/libstdc++.so.6 (0x5)\n"
                f"\tlibours.so => {self.folder}/kit/lib/libours.so (0x6)\n")
        with self.needs(text):
            packed, left_out = libraries.to_pack([program], self.folder / "kit/lib")
        self.assertEqual(packed, {"libhdf5.so.103": str(mine)})
        self.assertEqual(left_out, ["libcufft.so.12", "libhuge.so.1"])

    def test_a_library_that_is_missing_here(self):
        with self.needs("\tlibfoo.so.1 => not found\n"):
            with self.assertRaisesRegex(place.Unusable, "p needs libfoo.so.1, which is not on this machine: install "
                                                        "it, or"):
                libraries.needed(["p"], self.folder)


if __name__ == "__main__":
    unittest.main()
