"""Hardware counters of the sums over neighbours, by NVIDIA Nsight Compute (ncu)."""

import csv
import os
import subprocess

from look import need_device
from place import EMULATED, find_tool, scratch
from scenes import command_of, scene
from verdicts import FAIL, PASS, NotRun

# Name of the pass -> part of the name of its kernel, an instance of run_for_each.
KERNELS = {"volume": "VolumePass", "derivatives": "DerivativeLoop", "pressure and shift": "Shift"}
METRICS = {
    "gpu__time_duration.sum": "time",
    "sm__throughput.avg.pct_of_peak_sustained_elapsed": "arithmetic, % of peak",
    "dram__throughput.avg.pct_of_peak_sustained_elapsed": "memory, % of peak",
    "lts__throughput.avg.pct_of_peak_sustained_elapsed": "cache, % of peak",
    "sm__warps_active.avg.pct_of_peak_sustained_active": "occupancy, %",
    "launch__registers_per_thread": "registers",
}
LAUNCHES = 3


def counters(place, out, report):
    """A few launches of each kernel in a run of the paper's scene."""
    need_device(out)
    tool = find_tool("ncu")
    if tool is None:
        raise NotRun("ncu is neither in PATH nor in /usr/local/cuda*/bin: install the CUDA toolkit's package "
                     "nsight-compute")
    if EMULATED:
        raise NotRun("the emulated device starts no kernels")
    folder = scratch(out)
    _, *run = command_of(place, folder, "run", [*scene("explicit", 500, 10), "run.precision=single"], "cuda")
    program, environment = place.watched("mesogen")
    for name, part in KERNELS.items():
        command = [tool, "--target-processes", "all", "--kernel-name-base", "demangled", "--kernel-name",
                   f"regex:{part}", "--launch-skip", "2", "--launch-count", str(LAUNCHES), "--metrics",
                   ",".join(METRICS), "--csv", "--page", "raw", program, *run]
        print("+", *command, flush=True)
        done = subprocess.run([str(part) for part in command], cwd=folder, capture_output=True, text=True, check=False,
                              env={**os.environ, **environment})
        print(done.stdout + done.stderr, flush=True)
        text = done.stdout + done.stderr
        if "ERR_NVGPUCTRPERM" in text:
            raise NotRun("this user may not read the counters of the device (ERR_NVGPUCTRPERM): run this as root, or "
                         "load the driver with NVreg_RestrictProfilingToAdminUsers=0")
        values = last_launch(done.stdout)
        if values:
            report.line(name, PASS, ", ".join(f"{shown} {values[metric]}" for metric, shown in METRICS.items()
                                              if metric in values))
        else:
            report.line(name, FAIL, f"ncu told nothing of kernels named {part} (exit code {done.returncode})")


def last_launch(text):
    """{metric: value with unit} of the last launch in what `ncu --csv --page raw` writes: names, units, launches."""
    lines = text.splitlines()
    start = next((n for n, line in enumerate(lines) if line.startswith('"ID"')), None)
    if start is None:
        return {}
    rows = list(csv.reader(line for line in lines[start:] if line.startswith('"')))
    if len(rows) < 3:
        return {}
    names, units, values = rows[0], rows[1], rows[-1]
    return {name: f"{value} {unit}".replace(" %", "").strip() for name, unit, value in zip(names, units, values)
            if name in METRICS}
