"""Read, analyse and draw the results of Mesogen.

    import mesogen
    run = mesogen.open("output/quickstart")
    run.fields                                  # names of the stored particle fields
    run["velocity"]                             # last frame: array N x 2, m/s, ordered by particle id
    run.field("order_tensor", frame=0)          # any frame; run.times holds their times
    run.series("flow", "v_rms")                 # (time, value) as the observer [observers.flow] recorded them
    run.director()                              # angle and order at each particle
    run.parameters["physics"]["activity"]       # the case as it ran

`mesogen.grid` brings particle fields to a regular grid, `mesogen.nematics` finds defects, and
`python3 -m mesogen.report DIR` draws the pictures. Needs numpy, h5py and matplotlib (python3-numpy, python3-h5py and
python3-matplotlib in Debian).
"""

from . import grid, nematics
from .errors import MesogenError, NoResults, NoSuchName
from .grid import Deposit, Grid
from .run import Run, open

__all__ = ["Deposit", "Grid", "MesogenError", "NoResults", "NoSuchName", "Run", "grid", "nematics", "open"]
