#!/usr/bin/python3
"""How fast is Mesogen? Every pass by the pair, whole steps by size, threads and variant, PySPH beside it.

    bench/speed.py [--build build/release] [--quick] [--only passes runs ...] [-o docs/performance]

Writes OUTPUT/speed.csv and puts the tables into OUTPUT.md, between its markers. The build needs the benchmarks
(scripts/setup all); without PySPH its rows are left out, without a CUDA device those of the last that there was
stay. Some 12 minutes on two free cores. --quick, one minute,
tells whether all works and is too rough to be quoted; that and --only print their tables and write nothing. --tables
makes the page's tables anew of the CSV that is there. --device-results OUT takes the tables of a device from the folder
that `scripts/device OUT` wrote, on this machine or on another one, and leaves all other tables.
"""

import argparse
import datetime
import importlib.util
import os
import pathlib
import sys
import textwrap
import time

import device_figures
from device_figures import device_steps, origin_figures, share_figures, time_figures
from speed_runs import (PROJECT, best_of, call, device_name, device_seconds, instruction_set, measure_passes,
                        peer_seconds, run_paper, tell)
from speed_tables import Figure, markdown, put_into, read_csv, row, write_csv

KERNELS = ["quintic", "wendland_c2", "wendland_c4", "wendland_c6"]
CORNERS = {"machine": "machine", "blocks": "precision", "passes": "pass", "kernels": "ns a pair",
           "sizes": "particles", "threads": "threads", "variants": "variant", "shares": "part of a step",
           "peers": "program", "device": "particles on the device", "device shares": "part of a step on the device",
           "device roofline": "pass on the device"}
MOST_LOAD = 0.2  # cores that are busy before measuring begins
PRECISIONS = ["single", "double"]
MACHINE = "machine of this run"
BASE = "single precision, ghosts, quintic"
VARIANTS = {
    BASE: [],
    "double precision": ["run.precision=double"],
    "boundary that wraps": ["domain.boundary=periodic_wrap"],
    "Wendland C2": ["kernel.type=wendland_c2", "kernel.smoothing_length=2.0"],
    "Wendland C4": ["kernel.type=wendland_c4", "kernel.smoothing_length=2.0"],
    "Wendland C6": ["kernel.type=wendland_c6", "kernel.smoothing_length=2.0"],
    "plain Laplacian": ["kernel.laplacian=plain"],
}
# Arguments, neighbours within the support, loops over pairs a step.
PEERS = {
    "Mesogen, double": ([], 49.3, 3),
    "Mesogen, single": (["run.precision=single"], 49.3, 3),
    "PySPH TVF, as many neighbours": (["--scheme", "tvf", "--hdx", "1.3333"], 49.3, 2),
    "PySPH TVF, its own h": (["--scheme", "tvf"], 27.3, 2),
}
# across, repetitions or rounds, and how many particle-steps a run takes.
FULL = {"passes": (500, 3, 0.1), "sizes": ([100, 200, 500, 1000], 3, 4e6), "variants": (500, 3, 4e6),
        "peers": (100, 2, 2e6), "device": ([500, 1000, 3162, 10000], 3, 4e8)}
QUICK = {"passes": (120, 1, 0.01), "sizes": ([60, 100], 1, 1e5), "variants": (100, 1, 1e5), "peers": (40, 1, 3e5),
         "device": ([100, 200], 1, 1e6)}


def core_count():
    return len(os.sched_getaffinity(0))


def busy_cores(seconds=2.0):
    """How many cores compute for others, or are taken away by the host of a virtual machine."""
    def ticks():
        with open("/proc/stat", encoding="utf-8") as file:
            user, nice, system, _, _, irq, softirq, steal = map(int, file.readline().split()[1:9])
        return user + nice + system + irq + softirq + steal
    before = ticks()
    time.sleep(seconds)
    return (ticks() - before) / os.sysconf("SC_CLK_TCK") / seconds


def steps_for(particle_steps, across):
    return int(min(400, max(8, particle_steps / across**2)))


def millions_a_second(across, seconds):
    return 1e-6 * across**2 / seconds


def passes(options, effort):
    best = measure_passes(options.build / f"bin/passes-{instruction_set(options.mesogen)}", *effort)
    peak = {precision: best[f"machine: multiply, add/{precision}"]["operations_per_second"] for precision in PRECISIONS}
    figures = [Figure("machine", f"operations, {precision} precision", "a core can do",
                      f"{1e-9 * peak[precision]:.3g} Gflop/s") for precision in PRECISIONS]
    bandwidth = best["machine: triad"]["bytes_per_second"]
    figures += row("machine", "memory, read and written", {"a core can do": f"{1e-9 * bandwidth:.3g} GB/s"})
    names = {name.split("/")[0] for name in best if not name.startswith("machine")}
    for name in sorted(names, key=lambda name: (best[f"{name}/quintic/single"]["operations_a_pair"], name)):
        columns = {"flop a pair": best[f"{name}/quintic/single"]["operations_a_pair"]}
        for precision in PRECISIONS:
            one = best[f"{name}/quintic/{precision}"]
            columns[f"ns a pair, {precision}"] = 1e9 / one["pairs_per_second"]
            columns[f"% of peak, {precision}"] = 100 * one["operations_per_second"] / peak[precision]
        figures += row("passes", name, columns)
        figures += row("kernels", name, {f"{kernel.replace('wendland_c', 'C')}, {precision}":
                                         1e9 / best[f"{name}/{kernel}/{precision}"]["pairs_per_second"]
                                         for precision in PRECISIONS for kernel in KERNELS})
    for precision in PRECISIONS:
        some = best[f"volume/quintic/{precision}"]
        figures += row("blocks", precision, {"neighbours a particle": some["neighbours"],
                                             "blocks that hold them": some["blocks"],
                                             "lanes computed a neighbour": some["lanes_a_pair"]})
    return figures


def sizes(options, effort):
    across, rounds, budget = effort
    figures = []
    for count in sorted({1, core_count()}):
        variants = {f"{n * n:,}": (options.mesogen, n, steps_for(budget, n), count, []) for n in across}
        tell(f"sizes, {count} threads")
        best = best_of(rounds, variants, run_paper)
        label = f"{count} thread{'s' if count > 1 else ''}"
        least = best[f"{across[0]**2:,}"].step / across[0]**2
        for n, (name, run) in zip(across, best.items()):
            figures += row("sizes", name, {f"ms a step, {label}": 1e3 * run.step,
                                           f"million particle-steps/s, {label}": millions_a_second(n, run.step),
                                           f"a particle over the first, {label}": run.step / n**2 / least})
            if count == core_count():
                figures += row("sizes", name, {"ms a sorting": 1e3 * run.sorting})
    return figures


def threads(options, effort):
    across, rounds, budget = effort
    counts = [n for n in (1, 2, 4, 8, 16, 32, 64) if n <= core_count()]
    variants = {str(n): (options.mesogen, across, steps_for(budget, across), n, []) for n in counts}
    tell("threads")
    best = best_of(rounds, variants, run_paper)
    figures = []
    for name, run in best.items():
        speedup = best["1"].step / run.step
        figures += row("threads", name, {"ms a step": 1e3 * run.step, "times as fast": speedup,
                                         "efficiency, %": 100 * speedup / int(name)})
    alone = best["1"]
    for name, seconds in sorted(alone.shares.items(), key=lambda share: -share[1]):
        figures += row("shares", name, {"ms a step": 1e3 * seconds, "%": 100 * seconds / sum(alone.shares.values())})
    return figures


def variants(options, effort):
    across, rounds, budget = effort
    tell("variants")
    chosen = {name: (options.mesogen, across, steps_for(budget, across), core_count(), settings)
              for name, settings in VARIANTS.items()}
    best = best_of(rounds, chosen, run_paper)
    figures = []
    for name, run in best.items():
        figures += row("variants", name, {"ms a step": 1e3 * run.step, "over the first": run.step / best[BASE].step})
    return figures


def peers(options, effort):
    across, rounds, budget = effort
    chosen = {name: one for name, one in PEERS.items()
              if not name.startswith("PySPH") or importlib.util.find_spec("pysph") is not None}
    least = {}
    for _ in range(rounds):
        for name, (arguments, _, _) in chosen.items():
            steps = steps_for(budget * (1 if name.startswith("PySPH") else 4), across)
            seconds = peer_seconds(options.mesogen, across, steps, name, arguments)
            tell(f"  {name}: {millions_a_second(across, seconds):.3g} million particle-steps/s")
            least[name] = min(seconds, least.get(name, seconds))
    figures = []
    for name, (_, neighbours, loops) in chosen.items():
        rate = millions_a_second(across, least[name])
        figures += row("peers", name, {"neighbours": neighbours, "loops a step": loops,
                                       "million particle-steps/s": rate,
                                       "million interactions/s": rate * neighbours * loops})
    return figures


def device(options, effort):
    """Whole steps on a CUDA device; nothing where there is none. Sortings are in them: a run is timed as a whole."""
    across, rounds, budget = effort
    name = device_name(options.mesogen)
    if name is None:
        tell("device: there is none, left out")
        return []
    tell(f"device: {name}")
    figures = []
    for n in across:
        for precision in PRECISIONS if n <= 1000 else PRECISIONS[:1]:
            seconds = min(device_seconds(options.mesogen, n, device_steps(budget, n), [f"run.precision={precision}"])
                          for _ in range(rounds if n <= 1000 else 1))
            figures += time_figures(n, precision, seconds)
        figures += origin_figures(n, name)
    return figures + share_figures(across[0], run_paper(options.mesogen, across[0], 200, core_count(),
                                                        ["run.device=cuda"]).shares)


def machine(options, load):
    """Where and when it was measured, and whether that can be relied on, in a sentence. `load`: before it began."""
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        names = [line.split(":")[1].strip() for line in file if line.startswith("model name")]
    return (f"{names[0] if names else 'unknown processor'}, {core_count()} cores, instruction set "
            f"{instruction_set(options.mesogen)}; {call([options.mesogen, '--version'], None).strip()}; "
            f"{datetime.date.today().isoformat()}" +
            (f"; **the machine was busy (load {load:.1f}): rough**" if load > MOST_LOAD else ""))


def tables(figures):
    """All tables of the page, by name, as Markdown."""
    blocks = {name: markdown(figures, name, corner) for name, corner in CORNERS.items()
              if any(figure.table == name for figure in figures)}
    sentence = next(figure.value for figure in figures if figure.table == MACHINE)
    blocks[MACHINE] = textwrap.fill(sentence, 120, break_long_words=False, break_on_hyphens=False)
    return blocks


MEASURES = {"passes": (passes, "passes"), "sizes": (sizes, "sizes"), "threads": (threads, "variants"),
            "variants": (variants, "variants"), "peers": (peers, "peers"), "device": (device, "device")}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=PROJECT / "build/release", type=pathlib.Path)
    parser.add_argument("--quick", action="store_true", help="a rough look; written to the terminal alone")
    parser.add_argument("--only", nargs="+", choices=list(MEASURES), default=list(MEASURES))
    parser.add_argument("--tables", action="store_true", help="make the tables of the CSV that is there")
    parser.add_argument("--device-results", metavar="OUT",
                        help="take the tables of a device from the folder that `scripts/device OUT` wrote")
    parser.add_argument("-o", "--output", default=PROJECT / "docs/performance", type=pathlib.Path)
    options = parser.parse_args()
    options.mesogen = (options.build / "bin/mesogen").resolve()
    file, page = options.output / "speed.csv", options.output.with_suffix(".md")
    if options.tables:
        figures = read_csv(file)
    elif options.device_results is not None:
        figures = [figure for figure in read_csv(file) if figure.table not in device_figures.TABLES]
        figures += device_figures.read_results(options.device_results)
    else:
        load = busy_cores()
        if load > MOST_LOAD:
            tell(f"warning: the machine is busy, its load is {load:.1f}: figures will be too slow")
        figures = []
        for name in options.only:
            measure, effort = MEASURES[name]
            figures += measure(options, (QUICK if options.quick else FULL)[effort])
        figures += row(MACHINE, "machine", {"": machine(options, load) + "."})
        if "device" in options.only and not any(figure.table == "device" for figure in figures) and file.exists():
            # Of the machine that had one: its rows say which, and when.
            figures += [figure for figure in read_csv(file) if figure.table in device_figures.TABLES]
    blocks = tables(figures)
    if options.quick or options.only != list(MEASURES):
        for name, block in blocks.items():
            print(f"{name}\n\n{block}\n")
        return
    file.parent.mkdir(parents=True, exist_ok=True)
    write_csv(file, figures)
    page.write_text(put_into(page.read_text(encoding="utf-8"), blocks), encoding="utf-8")
    print(f"{file}, {page}")


if __name__ == "__main__":
    sys.exit(main())
