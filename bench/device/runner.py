"""Runs the stages of scripts/device, each as a process of its own with a time limit, and adds up what they found."""

import os
import shutil
import signal
import subprocess
import sys
import threading
import time

from verdicts import FAIL, NOT_RUN, Line, read_report


def run_limited(command, log, seconds, environment=None):
    """Runs a command; what it prints goes to the terminal and to the file `log`.

    Returns its exit code, or None if it took longer than `seconds` and was killed, with all processes that it started.
    """
    with open(log, "w", encoding="utf-8", errors="replace") as file:
        process = subprocess.Popen([str(part) for part in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                   text=True, errors="replace", env=environment, start_new_session=True)

        def copy():
            for line in process.stdout:
                file.write(line)
                file.flush()
                sys.stdout.write(line)
                sys.stdout.flush()

        copier = threading.Thread(target=copy, daemon=True)
        copier.start()
        ended = False
        try:
            ended = wait_for_end(process, seconds)
        finally:
            # Also what a stage that ended has left behind. Until `wait`, no other group can have this number.
            os.killpg(process.pid, signal.SIGKILL)
            code = process.wait()
            copier.join(timeout=5)
            if not copier.is_alive():
                process.stdout.close()
    return code if ended else None


def wait_for_end(process, seconds):
    """Whether a process ends within this time. Its exit code is left to be asked for."""
    deadline = time.monotonic() + seconds
    while os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT | os.WNOHANG) is None:
        if time.monotonic() > deadline:
            return False
        time.sleep(0.02)
    return True


def verdicts_of(stage, lines, code, seconds):
    """The lines of a stage that ended with this exit code (None: killed after `seconds`): those that it wrote, and one
    more if it ended in another way than it should."""
    if code is None:
        return [*lines, Line(stage, "time limit", FAIL, f"killed after {seconds:.0f} s; what it did is in {stage}.log")]
    if code != 0 and not any(line.verdict == FAIL for line in lines):
        how = f"exit code {code}" if code > 0 else f"signal {signal.Signals(-code).name}"
        return [*lines, Line(stage, "end", FAIL, f"the stage ended with {how}; the reason is in {stage}.log")]
    if not lines:
        return [Line(stage, "end", FAIL, f"the stage gave no verdict; what it did is in {stage}.log")]
    return lines


def run_stages(stages, command, out, limit):
    """Runs all stages in order. stages: [(name, seconds)]; command(name): what runs one; limit: seconds for all.

    Returns (lines, figures, {stage: seconds that it took}).
    """
    lines, figures, took = [], [], {}
    begin = time.monotonic()
    (out / "parts").mkdir(parents=True, exist_ok=True)
    for name, seconds in stages:
        left = limit - (time.monotonic() - begin)
        if left < 5:
            lines.append(Line(name, "all", NOT_RUN, f"no time was left of the {limit:.0f} s for all stages; "
                                                    f"`--only {name}` runs this stage alone"))
            continue
        print(f"\n== {name}", flush=True)
        part = out / "parts" / f"{name}.jsonl"
        part.unlink(missing_ok=True)
        allowed = min(seconds, left)
        start = time.monotonic()
        code = run_limited(command(name), out / f"{name}.log", allowed)
        took[name] = time.monotonic() - start
        shutil.rmtree(out / "scratch", ignore_errors=True)
        found, measured = read_report(part)
        lines += verdicts_of(name, found, code, allowed)
        figures += measured
    return lines, figures, took
