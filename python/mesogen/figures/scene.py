"""One frame of a run, gridded once for all figures."""

from functools import cached_property

import numpy as np

from .. import nematics
from ..grid import Deposit, Grid, vorticity


class Scene:
    """A frame of a Run with its fields on a grid of about one cell per particle.

    run: an open Run. frame: its number, negative from the end; None for a run without frames: only its series
    are drawn.
    """

    def __init__(self, run, frame):
        self.run = run
        self.frame = None if frame is None else run.frame_index(frame)
        self.box = run.box
        self.time = None if frame is None else float(run.times[self.frame])
        self.step = None if frame is None else int(run.steps[self.frame])

    @property
    def time_label(self):
        return f"time ({self.run.time_unit})"

    @property
    def time_text(self):
        return "" if self.time is None else f"t = {self.time:.4g} {self.run.time_unit}"

    def has(self, *fields):
        """Whether these fields are stored, with positions to draw them at."""
        return self.frame is not None and all(name in self.run for name in ("position", *fields))

    def lacks(self, *fields):
        """Why these fields cannot be drawn, None if they can."""
        if self.frame is None:
            return "no frame of particles is stored yet"
        gone = [name for name in ("position", *fields) if name not in self.run]
        return f"field {', '.join(gone)} is not stored (see 'fields' in [output])" if gone else None

    @cached_property
    def position(self):
        return np.asarray(self.run.field("position", self.frame), dtype=float)

    @cached_property
    def grid(self):
        return self._grid()

    def _grid(self, refine=1.0):
        # Solids may fill most of the box: the number of particles does not tell how far apart they are.
        spacing = self.run.parameters.get("particles", {}).get("spacing")
        count = self.run.count if spacing is None else np.prod(self.box[:2]) / spacing**2
        return Grid.for_particles(self.box, count, refine, self.run.periodic, self.run.length_unit)

    @cached_property
    def deposit(self):
        return Deposit(self.grid, self.position)

    @cached_property
    def order_tensor(self):
        """(Q11, Q12) on the grid."""
        stored = self.run.field("order_tensor", self.frame)
        return tuple(self.deposit(stored[:, c]) for c in (0, 1))

    @cached_property
    def velocity(self):
        """(u, v) on the grid."""
        stored = self.run.field("velocity", self.frame)
        return tuple(self.deposit(stored[:, c]) for c in (0, 1))

    @cached_property
    def activity(self):
        """Of an activity that varies, on the grid."""
        return self.deposit(self.run.field("activity", self.frame))

    @cached_property
    def vorticity(self):
        return vorticity(*self.velocity, self.grid)

    @cached_property
    def colour(self):
        """Grid, finer than the particles, and the colour averaged to it."""
        grid = self._grid(refine=1.5)
        return grid, Deposit(grid, self.position).average(self.run.field("colour", self.frame))

    @cached_property
    def defects(self):
        """Rows of x, y, charge, orientation: as the observer recorded them at this step, else found on the grid."""
        observer = self.run.observer_of("defects", "count_plus")
        if observer is not None:
            sampled = np.nonzero(self.run.series_steps(observer, "defects") == self.step)[0]
            if len(sampled):
                return np.asarray(self.run.table(observer, "defects", int(sampled[-1])), dtype=float)
        return nematics.find_defects(*self.order_tensor, self.grid)

    def until_now(self, observer, quantity):
        """(time, value) of the samples up to this frame; all of them if there is no frame."""
        time, value = self.run.series(observer, quantity)
        if self.step is None:
            return time, value
        seen = self.run.series_steps(observer, quantity) <= self.step
        return time[seen], value[seen]
