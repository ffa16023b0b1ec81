"""Sweeps: one case over a grid of parameters and seeds. `mesogen sweep SWEEP.toml`, or from Python:

    from mesogen.sweep import finished, read_sweep, run_sweep
    sweep = read_sweep("studies/activity.toml", extra={"time.end": 50.0})
    sweep.runs                                          # each with label, point, seed, overrides
    run_sweep(sweep, "output/sweeps/activity", "build/release/bin/mesogen", parallel=4)
    for one in finished(sweep, "output/sweeps/activity"):
        with one.open() as run:                         # a mesogen.Run
            time, v_rms = run.series("flow", "v_rms")

Every run is one process with its results in runs/LABEL. runs.csv tells how each run ended, so that an interrupted sweep
goes on where it was. Errors: mesogen.errors.StudyError.
"""

from ..runs.finished import Finished, finished
from ..runs.runner import run_sweep
from ..runs.sweep_file import Point, Quantity, Run, Sweep, read_sweep
from .tables import write_tables

__all__ = ["Finished", "Point", "Quantity", "Run", "Sweep", "finished", "read_sweep", "run_sweep", "write_tables"]
