"""How long a step takes on the device: the paper's scene by size, its parts, and `incompressible`."""

import json
import os
import re
import shutil
import subprocess
import time

from device_figures import device_steps, origin_figures, share_figures, time_figures
from look import need_device, seen
from place import EMULATED, scratch
from scenes import has_code_for_cuda
from speed_runs import SPACING, STEP, device_seconds, paper_case, run_paper
from verdicts import NOT_RUN, PASS, NotRun

# Particles along each edge -> ms a step at the most, and what would be better.
GOALS = {500: (0.3, 0.15), 3162: (12.0, 9.0)}
INCOMPRESSIBLE_GOAL = 2.0  # ms a step, 500 x 500
BUDGET = 1e4 if EMULATED else 4e8  # particle-steps of a run
THREADS = int(os.environ.get("OMP_NUM_THREADS") or len(os.sched_getaffinity(0)))
BYTES_A_PARTICLE = 370  # on the device
PRESSED = ["output.checkpoint_interval=100000.0", 'output.fields=["position"]']  # as little output as there can be


def judge_time(report, what, seconds, goal=None, stretch=None):
    """A line on the time of a step; judged by its goal, in ms, on a device alone."""
    milliseconds = 1e3 * seconds
    text = f"{milliseconds:.3g} ms a step"
    if goal is None or EMULATED:
        report.line(what, PASS, text + (", not judged" if EMULATED else ""), milliseconds=milliseconds)
        return
    text += f" (goal {goal:g}" + (f", better {stretch:g}: {'reached' if milliseconds <= stretch else 'missed'})"
                                  if stretch else ")")
    report.judge(what, milliseconds <= goal, text, milliseconds=milliseconds, goal=goal)


def keep_shares(out, across, run):
    """What a traced run told of its parts, for the stage `roofline`."""
    (out / f"shares_{across}.json").write_text(json.dumps(run.shares, indent=2) + "\n", encoding="utf-8")


def measure(place, out, report, sizes, precisions):
    for across in sizes:
        for precision in precisions:
            steps = device_steps(BUDGET, across)
            seconds = device_seconds(place.mesogen, across, steps, [f"run.precision={precision}"])
            goals = GOALS.get(across, ()) if precision == "single" else ()
            judge_time(report, f"{across * across:,} particles, {precision} precision", seconds, *goals)
            report.figures(time_figures(across, precision, seconds))
        report.figures(origin_figures(across, seen(out).get("device", "unknown device")))


def shares(place, out, report, across, steps):
    """The parts of a step; each is waited for."""
    run = run_paper(place.mesogen, across, steps, THREADS, ["run.device=cuda", *PRESSED])
    keep_shares(out, across, run)
    longest = sorted(run.shares.items(), key=lambda share: -share[1])
    total = sum(run.shares.values())
    for name, seconds in longest:
        print(f"{100 * seconds / total:6.2f} %  {1e3 * seconds:9.4f} ms a step  {name}")
    report.line(f"{across * across:,} particles, parts of a step", PASS,
                "; ".join(f"{100 * seconds / total:.0f} % {name}" for name, seconds in longest[:4]) +
                f"; a sorting {1e3 * run.sorting:.3g} ms", **{name: 1e3 * seconds for name, seconds in longest})
    report.figures(share_figures(across, run.shares))


def speed(place, out, report):
    """500 x 500 and 1000 x 1000 particles, and `incompressible`."""
    need_device(out)
    sizes = [40, 60] if EMULATED else [500, 1000]
    measure(place, out, report, sizes, ["single"] if EMULATED else ["single", "double"])
    shares(place, out, report, sizes[0], 10 if EMULATED else 200)
    what = f"incompressible, {sizes[0]**2:,} particles"
    if not has_code_for_cuda(place, "incompressible"):
        report.line(what, NOT_RUN, "'incompressible' has no code for CUDA in this build")
        return
    steps = device_steps(BUDGET / 10, sizes[0])
    judge_time(report, what, device_seconds(place.mesogen, sizes[0], steps, ["physics.flow.type=incompressible"]),
               INCOMPRESSIBLE_GOAL)


def large_speed(place, out, report):
    """3162 x 3162 particles."""
    need_device(out)
    across = 80 if EMULATED else 3162
    need_memory(out, across)
    measure_to_the_last_step(place, out, report, across, 10 if EMULATED else 200)
    shares(place, out, report, across, 10 if EMULATED else 30)


def need_memory(out, across):
    """Raises NotRun where the memory of the device is too small for so many particles."""
    free, needed = seen(out).get("memory_free_bytes"), BYTES_A_PARTICLE * across**2
    if free is not None and needed > 0.9 * free:
        raise NotRun(f"{across * across:,} particles need some {1e-9 * needed:.0f} GB of the device, which has "
                     f"{1e-9 * free:.0f} GB free")


def largest_speed(place, out, report):
    """10,000 x 10,000 particles."""
    need_device(out)
    across, steps = (100, 5) if EMULATED else (10000, 40)
    need_memory(out, across)
    measure_to_the_last_step(place, out, report, across, steps)


def measure_to_the_last_step(place, out, report, across, steps):
    """One run, which is killed after its last step: what it would write at its end takes longer than the steps."""
    folder = scratch(out)
    (folder / "case.toml").write_text(paper_case(), encoding="utf-8")
    command = [str(place.mesogen), "run", "case.toml", "--output", "out", "--overwrite"]
    edge = across * SPACING
    for setting in (f"domain.size=[{edge!r}, {edge!r}]", f"time.step={STEP}", f"time.end={steps * STEP!r}",
                    "run.device=cuda", "run.precision=single", *PRESSED):
        command += ["--set", setting]
    begin = time.monotonic()
    seconds, text = seconds_until_the_last_step(command, folder)
    shutil.rmtree(folder)
    what = f"{across * across:,} particles"
    report.judge(f"{what} fit and run", seconds is not None,
                 f"{steps} steps, {time.monotonic() - begin:.0f} s with the start" if seconds is not None
                 else f"the run ended before its last step: {text}")
    if seconds is not None:
        judge_time(report, f"{what}, single precision", seconds, *GOALS.get(across, ()))
        report.figures(time_figures(across, "single", seconds))
        report.figures(origin_figures(across, seen(out).get("device", "unknown device")))


def seconds_until_the_last_step(command, folder):
    """(seconds a step, "") as the line of progress after the last step tells; (None, last line) if there is none."""
    last = ""
    with subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as process:
        try:
            for line in process.stdout:
                print(line, end="", flush=True)
                last = line.strip() or last
                found = re.search(r"100 %.* steps in .*\s(\S+) steps/s", line)
                if found:
                    return 1.0 / float(found[1]), ""
        finally:
            process.kill()
    return None, last
