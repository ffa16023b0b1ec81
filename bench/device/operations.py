"""Operations per pair of the sums over neighbours, as the program bench/passes counts them.

The program needs a library that a bare machine lacks, so a kit holds what it counted (operations.json).
"""

import json
import os

from place import PROJECT
from speed_runs import instruction_set, measure_passes
from verdicts import NotRun

ONLY = "^(volume|consistent derivatives of 4|pressure, viscosity, shift and density diffusion)/quintic/single"
KEPT = ("operations_a_pair", "neighbours")


def count_operations(place):
    """{pass: {"operations_a_pair", "neighbours"}}; raises NotRun where the program was not built."""
    name = f"passes-{instruction_set(place.mesogen)}"
    program = place.program(name)
    if not os.access(program, os.X_OK):
        raise NotRun(f"{program}, which counts operations, was not built: build it by "
                     "`MESOGEN_CUDA=on scripts/setup all`")
    counted = measure_passes(program, 60, 1, 0.001, ONLY)
    return {name.split("/")[0]: {key: counters[key] for key in KEPT} for name, counters in counted.items()}


def read_operations(place):
    """Of the kit, or counted here."""
    if place.kit is not None:
        return json.loads((PROJECT / "bench/device/operations.json").read_text(encoding="utf-8"))
    return count_operations(place)
