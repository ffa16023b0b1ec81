#!/usr/bin/python3
"""What does each part of the model cost? The paper's scene with parts switched off and on.

    bench/model_cost.py build/release/bin/mesogen [--particles 500] [--threads 2] [--rounds 3] [-o docs/model_cost.md]

The time of a step is that of `mesogen check`, which takes steps for two seconds and writes nothing. The variants take
turns, so that other work of the machine affects all of them alike. The table gives medians over the rounds, their ratio
to the full model, and what a second of simulated time costs, because the step size also depends on the model. Memory is
what `mesogen check` predicts. With 500 x 500 particles on two cores a round takes about 80 s.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import textwrap

BASE = {
    "domain": 'size = [10.0, 10.0]\nboundary = "periodic_ghosts"',
    "particles": "spacing = {spacing}",
    "kernel": 'type = "quintic"\nsmoothing_length = 1.3333333333333333',
    "director": 'type = "perturbed"\namplitude = 0.1',
    "physics.flow": 'type = "wcsph"\ndensity = 1.0\nviscosity = 0.6666666666666667',
    "physics.nematic": 'type = "beris_edwards"\nrotational_diffusivity = 0.4\nflow_alignment = 0.7\n'
                       "elastic_constant = 0.02\nbulk = {{ A = -1.0, C = 0.5 }}",
    "physics.activity": 'type = "active_stress"\nactivity = 0.023',
    "time": "end = 100.0",
    "run": 'precision = "single"',
}
PLAIN_KERNEL = 'type = "wendland_{}"\nsmoothing_length = 2.0'

# But for the filter and the viscosity, which are those of the published scheme.
LIKE_WCSPH = """type = "wcsph_published"
density = 1.0
viscosity = 0.6666666666666667
density_diffusion = 0.1
shift_speed = "strain"
shift = 0.3
"""

# What is changed: sections without, sections in place or beside, or lines added to a section.
VARIANTS = [
    ("the full model: flow, nematic, activity", [], {}, {}),
    ("explicit steps", [], {}, {"time": 'stepping = "explicit"'}),
    ("incompressible flow", [],
     {"physics.flow": 'type = "incompressible"\ndensity = 1.0\nviscosity = 0.6666666666666667'}, {}),
    ("without activity", ["physics.activity"], {}, {}),
    ("without the nematic: a plain fluid", ["physics.activity", "physics.nematic", "director"], {}, {}),
    ("without flow: the nematic alone", ["physics.activity", "physics.flow"], {}, {}),
    ("with elastic stress", [], {"physics.elasticity": 'type = "elastic_stress"'}, {}),
    ("with friction", [], {"physics.substrate": 'type = "friction"\ncoefficient = 0.1'}, {}),
    ("with the published density filter", [], {"physics.flow": LIKE_WCSPH + 'viscosity_form = "component"'}, {}),
    ("without the shift", [], {}, {"physics.flow": "shift = 0.0"}),
    ("without the density diffusion", [], {}, {"physics.flow": "density_diffusion = 0.0"}),
    ("radial viscosity", [], {"physics.flow": LIKE_WCSPH + "density_filter = 0.0"}, {}),
    ("plain Laplacian", [], {}, {"kernel": 'laplacian = "plain"'}),
    ("published half steps", [], {}, {"time": 'scheme = "half_steps"'}),
    ("conservative pressure and active stress", [],
     {"physics.activity": 'type = "active_stress"\nactivity = 0.023\nform = "conservative"'},
     {"physics.flow": 'pressure_form = "conservative"'}),
    ("particles that stay", [], {}, {"physics.flow": 'motion = "eulerian"'}),
    ("kernel Wendland C2", [], {"kernel": PLAIN_KERNEL.format("c2")}, {}),
    ("kernel Wendland C4", [], {"kernel": PLAIN_KERNEL.format("c4")}, {}),
    ("kernel Wendland C6", [], {"kernel": PLAIN_KERNEL.format("c6")}, {}),
    ("boundary that wraps, without copies", [], {"domain": 'size = [10.0, 10.0]\nboundary = "periodic_wrap"'}, {}),
    ("double precision", [], {"run": 'precision = "double"'}, {}),
]


def case_text(across, without, instead, added):
    """The case of a variant."""
    sections = {name: lines for name, lines in BASE.items() if name not in without}
    sections.update(instead)
    for name, lines in added.items():
        sections[name] += "\n" + lines
    text = "".join(f"[{name}]\n{lines}\n" for name, lines in sections.items())
    return text.format(spacing=10.0 / across)


def check(mesogen, text, threads):
    """What `mesogen check` finds: seconds a step, size of a step (s), memory (bytes)."""
    with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
        file.write(text)
        file.flush()
        done = subprocess.run([mesogen, "check", file.name, "--threads", str(threads), "--json"], text=True,
                              capture_output=True, check=False)
    if done.returncode != 0:
        sys.exit(done.stderr)
    told = json.loads(done.stdout)
    return told["time"]["step"], told["steps"]["step"], told["memory"]["peak"]


def processor():
    """The name of the processor."""
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        names = [line.split(":")[1].strip() for line in file if line.startswith("model name")]
    return names[0] if names else "an unknown processor"


def measure(mesogen, across, threads, rounds):
    """For each variant its (seconds a step, step s, bytes), medians over rounds in which all take turns."""
    found = [[] for _ in VARIANTS]
    for number in range(rounds):
        for n, (name, *changes) in enumerate(VARIANTS):
            print(f"\rround {number + 1} of {rounds}: {name:50}", end="", file=sys.stderr, flush=True)
            found[n].append(check(mesogen, case_text(across, *changes), threads))
    print(file=sys.stderr)
    return [tuple(statistics.median(column) for column in zip(*runs)) for runs in found]


def page(results, across, threads, rounds):
    """The table as a page of Markdown."""
    full = results[0]
    lines = ["# What each part of the model costs", "",
             *textwrap.wrap(
                 "Use this table to see what a part of the model costs before you switch it on or off. It shows the "
                 f"paper's scene (zeta = 0.023 Pa, K = 0.02 N, ...) with {across} x {across} particles, in single "
                 f"precision unless a row says otherwise, on {threads} thread{'s' if threads > 1 else ''} of "
                 f"{processor()}. The numbers are medians of {rounds} rounds, in which the variants take turns. "
                 "`bench/model_cost.py` measures them and writes this page.", 120), "",
             *textwrap.wrap(
                 "`ms a step`: wall time per step. `step, ms`: simulated time per step. `s for 1 s`: wall time for one "
                 "second of simulated time. `over full`: the column before it, divided by that of the full model. "
                 "Memory is what `mesogen check` predicts.", 120), "",
             "| model | ms a step | over full | step, ms | s for 1 s | over full | memory, MB |",
             "|---|---|---|---|---|---|---|"]
    for (name, *_), (seconds, step, memory) in zip(VARIANTS, results):
        lines.append(f"| {name} | {1e3 * seconds:.3g} | {seconds / full[0]:.2f} | {1e3 * step:.3g} | "
                     f"{seconds / step:.3g} | {seconds / step / (full[0] / full[1]):.2g} | {memory / 1e6:.0f} |")
    still = results[[name for name, *_ in VARIANTS].index("without flow: the nematic alone")]
    lines += ["", f"Without flow a step is {full[0] / still[0]:.1f} times as fast: nothing moves, so neighbours and "
              "weights of derivatives are found only once."]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesogen")
    parser.add_argument("--particles", type=int, default=500, help="along each edge of the box")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("-o", "--output", help="file to write (default: print)")
    options = parser.parse_args()
    results = measure(os.path.abspath(options.mesogen), options.particles, options.threads, options.rounds)
    text = page(results, options.particles, options.threads, options.rounds)
    if options.output:
        with open(options.output, "w", encoding="utf-8") as file:
            file.write(text)
    else:
        print(text, end="")


if __name__ == "__main__":
    main()
