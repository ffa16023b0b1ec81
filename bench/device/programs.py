"""Programs that test the device: device_passes, the tests of the command, and two tools of compute-sanitizer."""

import os
import re
import subprocess
import sys

from agreement import need_hdf5
from look import need_device
from place import EMULATED, PROJECT, find_tool, scratch
from scenes import command_of, scene
from verdicts import FAIL, NOT_RUN, PASS, NotRun

NO_DEVICE = 77  # exit code of device_passes
QUICK_TESTS = ["OnCuda.test_observers_see_the_newest_values", "OnCuda.test_replay_needs_no_device",
               "OnCuda.test_info_tells_who_has_code"]
FOUND = 86  # exit code that compute-sanitizer is asked for where it finds something


def shown(command, folder=None, **environment):
    """Runs a command, prints each line when it comes, and returns (exit code, all that it wrote)."""
    print("+", *command, flush=True)
    text = ""
    with subprocess.Popen([str(part) for part in command], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, errors="replace", env={**os.environ, **environment}) as process:
        for line in process.stdout:
            print(line, end="", flush=True)
            text += line
    return process.returncode, text


def device_passes(place, out, report):
    """Pair sums on the device against those on the host, without a run around them."""
    need_device(out)
    code, text = shown([place.program("device_passes")])
    differences = [float(value) for value in re.findall(r"host against device (\S+) \(bound", text)]
    if code == NO_DEVICE:
        report.line("pair sums", NOT_RUN, "there is no CUDA device here; the host's sums agree with the exact ones")
    elif code != 0:
        report.line("pair sums", FAIL, f"exit code {code}: {last_line(text)}", differences=differences)
    else:
        report.line("pair sums", PASS, "host against device: " + ", ".join(f"{value:.1e}" for value in differences),
                    differences=differences)


def command_tests(place, out, report):
    """tests/command/test_device.py, with the command that is tested here."""
    need_device(out)
    need_hdf5()
    code, text = shown([sys.executable, "-B", PROJECT / "tests/command/test_device.py", "-v",
                        *(QUICK_TESTS if EMULATED else [])],
                       MESOGEN=str(place.mesogen), BROKEN_PLUGINS="", DEVICE_IS_HERE="0" if EMULATED else "1")
    ran = re.search(r"Ran (\d+) tests? in (\S+)s", text)
    if code == 0 and ran:
        skipped = re.search(r"skipped=(\d+)", text)
        report.line("tests of the command", PASS, f"{ran[1]} tests in {ran[2]} s" +
                    (f", {skipped[1]} of them skipped" if skipped else ""), tests=int(ran[1]))
    else:
        failed = re.findall(r"^(?:FAIL|ERROR): (.+)$", text, re.MULTILINE)
        report.line("tests of the command", FAIL, "; ".join(failed) or f"exit code {code}: {last_line(text)}")


def sanitizer(tool):
    """The stage that runs a tool of compute-sanitizer over device_passes and over 20 steps of a small case."""
    def stage(place, out, report):
        need_device(out)
        checker = find_tool("compute-sanitizer")
        if checker is None:
            raise NotRun("compute-sanitizer is neither in PATH nor in /usr/local/cuda*/bin: install the CUDA "
                         "toolkit's package cuda-sanitizer")
        if EMULATED:
            raise NotRun("the emulated device starts no kernels")
        checker = [checker, "--tool", tool, "--error-exitcode", FOUND, "--target-processes", "all"]
        folder = scratch(out)
        _, *run = command_of(place, folder, "sanitizer", scene("explicit", 32, 20), "cuda")
        for what, name, arguments in (("pair sums", "device_passes", []), ("20 steps", "mesogen", run)):
            program, environment = place.watched(name)
            code, text = shown([*checker, program, *arguments], folder, **environment)
            errors = re.findall(r"ERROR SUMMARY: (\d+) error", text)
            if code == 0 and errors:
                report.line(what, PASS, f"{tool} found no error", errors=0)
            else:
                first = re.search(r"^=+ ((?:Invalid|Uninitialized|Program hit|Error).*)$", text, re.MULTILINE)
                report.line(what, FAIL, f"exit code {code}, {errors[-1] if errors else 'an unknown number of'} errors: "
                                        f"{first[1] if first else last_line(text)}")
    return stage


def last_line(text):
    lines = [line for line in text.splitlines() if line.strip()]
    return lines[-1].strip() if lines else "it wrote nothing"
