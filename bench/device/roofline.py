"""How near sums over neighbours come to what the device could do at most: the roofline of arithmetic and memory.

Operations per pair are those that bench/passes counts with a number that counts its operations, as for the host.
Times are those of the parts of a step that the stages of speed measured, each waited for.
"""

import json

from look import need_device, seen
from operations import read_operations
from place import EMULATED
from speed_tables import row
from verdicts import PASS, NotRun

NUMBER = 4  # bytes, single precision
# What a pass reads and writes once per particle at the least, in numbers; neighbours are near each other in memory too.
# A value that is added to is read and written. Pass of a step (its beginning) -> name in bench/passes, numbers.
PASSES = {
    "framework: volume": ("volume", {"position": 2, "cell": 1, "volume": 1}),
    "framework: correction, ": ("consistent derivatives of 4", {
        "position": 2, "cell": 1, "volume": 1, "sources": 4, "gradients": 8, "Laplacians": 4, "correction": 4}),
    "physics.flow: pressure": ("pressure, viscosity, shift and density diffusion", {
        "position": 2, "cell": 1, "volume": 1, "pressure": 1, "density": 1, "correction": 4, "velocity gradient": 4,
        "compression": 1, "acceleration": 4, "shift": 4, "rate": 2}),
}


def least_seconds(operations, values, particles, peak, bandwidth):
    """Least time of a pass, s, and what binds: "arithmetic" or "memory"."""
    arithmetic = particles * operations["neighbours"] * operations["operations_a_pair"] / peak
    memory = particles * NUMBER * sum(values.values()) / bandwidth
    return max(arithmetic, memory), "arithmetic" if arithmetic > memory else "memory"


def roofline(place, out, report):
    """The share of the roofline that each sum over neighbours reaches, for each size whose parts were measured."""
    need_device(out)
    told = seen(out)
    peak, bandwidth = (told.get(name) for name in ("peak_single_flops_per_second", "on_device_bytes_per_second"))
    if EMULATED:
        raise NotRun("the emulated device has no peak to compare with")
    if peak is None or bandwidth is None:
        raise NotRun("the stage `look`, which measures the device, gave no numbers")
    operations = read_operations(place)
    files = sorted(out.glob("shares_*.json"), key=lambda file: int(file.stem.split("_")[1]))
    if not files:
        raise NotRun("the stages `speed` and `large`, which measure the parts of a step, gave no times")
    for file in files:
        particles = int(file.stem.split("_")[1])**2
        for line in lines_of(json.loads(file.read_text(encoding="utf-8")), operations, particles, peak, bandwidth):
            report.line(f"{particles:,} particles, {line['pass']}", PASS,
                        f"{100 * line['share']:.0f} % of the roofline: {1e3 * line['seconds']:.3g} ms, "
                        f"{1e3 * line['least']:.3g} ms by {line['binds']}", share=line["share"])
            report.figures(row("device roofline", line["pass"], {
                "flop a pair": operations[line["pass"]]["operations_a_pair"],
                f"ms, {particles:,} particles": 1e3 * line["seconds"],
                f"% of the roofline, {particles:,} particles": 100 * line["share"]}))


def lines_of(shares, operations, particles, peak, bandwidth):
    """One dictionary per pass that was measured and counted."""
    lines = []
    for beginning, (counted, values) in PASSES.items():
        for name, seconds in shares.items():
            if name.startswith(beginning) and counted in operations and seconds > 0:
                least, binds = least_seconds(operations[counted], values, particles, peak, bandwidth)
                lines.append({"pass": counted, "seconds": seconds, "least": least, "binds": binds,
                              "share": least / seconds})
    if not lines:
        raise NotRun(f"none of the parts of a step is a known sum over neighbours: {', '.join(shares)}")
    return lines
