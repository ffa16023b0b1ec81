#!/usr/bin/python3
"""How well does `mesogen check` predict a run? Each case is checked and run, one right after the other, several times.

    bench/check_prediction.py build/release/bin/mesogen [CASE ...] [--repeats 3] [--threads 1]

A CASE is a file, with what is changed in it behind: "cases/x/case.toml time.end=1 run.precision=double". Prints for
each the predicted wall time and processor time (s), peak memory (MB) and number of steps over those of the run:
medians, and the range of the ratios of wall time, which tells how noisy the machine is. Processor time is what remains
comparable where others use the machine too.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time

PROJECT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
CASES = ["cases/quickstart/case.toml time.end=10",
         "cases/accuracy/taylor_green/case.toml",
         "cases/accuracy/benchmark/case.toml",
         "cases/channel/poiseuille.toml",
         "cases/active_turbulence/paper.toml time.end=0.0133"]


def check(mesogen, case, settings, threads):
    """What `mesogen check --json` says."""
    done = subprocess.run([mesogen, "check", case, *settings, "--threads", threads, "--json"], check=True, text=True,
                          capture_output=True)
    return json.loads(done.stdout)


def run(mesogen, case, settings, threads):
    """(wall time s, processor time s, peak memory MB, steps) of a run: the whole process."""
    sys.path.insert(0, os.path.join(PROJECT, "python"))
    import mesogen as results
    with tempfile.TemporaryDirectory(prefix="mesogen-") as folder:
        output = os.path.join(folder, "run")
        start = time.perf_counter()
        subprocess.run([mesogen, "run", case, *settings, "--threads", threads, "--quiet", "--output", output],
                       check=True)
        wall = time.perf_counter() - start
        cost = results.open(output).cost
        return wall, cost.cpu_seconds, cost.peak_memory / 1e6, cost.steps


def measure(mesogen, text, repeats, threads):
    """Prints a line of the table."""
    case, *changes = text.split()
    settings = [word for change in changes for word in ("--set", change)]
    case = case if os.path.exists(case) else os.path.join(PROJECT, case)
    predicted, found = [], []
    for _ in range(repeats):
        told = check(mesogen, case, settings, threads)
        predicted.append((told["time"]["wall"], told["time"]["cpu"], told["memory"]["peak"] / 1e6,
                          told["steps"]["steps_at_least"]))
        found.append(run(mesogen, case, settings, threads))
    ratios = [[p / f for p, f in zip(*pair)] for pair in zip(predicted, found)]
    wall, cpu, memory, steps = (statistics.median(ratio[n] for ratio in ratios) for n in range(4))
    walls = [ratio[0] for ratio in ratios]
    print(f"| {text} | {statistics.median(f[0] for f in found):.1f} | {wall:.2f} ({min(walls):.2f} to {max(walls):.2f}) |"
          f" {cpu:.2f} | {statistics.median(f[2] for f in found):.1f} | {memory:.2f} | {found[0][3]} | {steps:.2f} |",
          flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesogen")
    parser.add_argument("cases", nargs="*", default=CASES)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--threads", default="1")
    options = parser.parse_intermixed_args()
    print("| case | wall time, s | predicted / run | processor time | memory, MB | predicted / run | steps | predicted / run "
          "|\n|---|---|---|---|---|---|---|---|")
    for case in options.cases:
        measure(os.path.abspath(options.mesogen), case, options.repeats, options.threads)


if __name__ == "__main__":
    main()
