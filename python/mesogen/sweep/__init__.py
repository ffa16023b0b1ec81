"""Sweeps: one case over a grid of parameters and seeds. `mesogen sweep SWEEP.toml`, or from Python:

    from mesogen.sweep import finished, read_sweep, run_sweep
    sweep = read_sweep("studies/activity.toml", extra={"time.end": 50.0})
    sweep.runs                                          # label, point, seed, overrides of each
    run_sweep(sweep, "output/sweeps/activity", "build/release/bin/mesogen", parallel=4)
    for one in finished(sweep, "output/sweeps/activity"):
        with one.open() as run:                         # a mesogen.Run
            time, v_rms = run.series("flow", "v_rms")

Every run is a process of its own and keeps its results in runs/LABEL; runs.csv tells how each ended, so that a sweep
that was broken off goes on where it was. Errors: mesogen.study.errors.
"""

from .collection import Finished, finished
from .runner import run_sweep
from .sweep_file import Point, Quantity, Run, Sweep, read_sweep
from .tables import write_tables

__all__ = ["Finished", "Point", "Quantity", "Run", "Sweep", "finished", "read_sweep", "run_sweep", "write_tables"]
