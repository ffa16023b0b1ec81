"""A finished or running simulation, read from its results.h5."""

import os
import tomllib
from collections import namedtuple

import h5py
import numpy as np

from . import nematics
from .errors import MesogenError, NoResults, NoSuchName, missing
from .units import stored_unit

GROUP = "particles/fluid"

# What a finished run took, all sessions together: steps; sessions (above 1: it was resumed); wall_seconds of stepping,
# without start-up; cpu_seconds of all threads; threads of the last session; peak_memory (resident, bytes).
Cost = namedtuple("Cost", "steps sessions wall_seconds cpu_seconds threads peak_memory")

# Where a branch started: the other run's folder, the checkpoint's file there, its time (s) and step, and what was changed
# in the case, a list of "key=value".
Origin = namedtuple("Origin", "folder checkpoint time step changes")


def open(path):
    """Open the results of a run.

    path: the run's folder, or its results.h5.
    Returns a Run. Raises NoResults where there are none that can be read.

    >>> run = mesogen.open("output/quickstart")
    >>> run.fields
    ['image', 'order_tensor', 'position', 'velocity']
    >>> velocity = run["velocity"]             # last frame, N x 2, in m/s, ordered by particle id
    >>> time, v_rms = run.series("flow", "v_rms")
    """
    return Run(path)


class Run:
    """The results of one run. Use as a context manager, or call close() when done.

    Arrays are numpy arrays; particle rows are ordered by particle id; numbers are in the units of the case: lengths in
    `length_unit`, m by default, times in `time_unit`.
    """

    def __init__(self, path):
        path = os.fspath(path)
        self.file = os.path.join(path, "results.h5") if os.path.isdir(path) else path
        self.folder = os.path.dirname(self.file) or "."
        if not os.path.exists(path):
            raise NoResults(f"{path}: no such folder; give the folder that 'mesogen run --output' wrote")
        if not os.path.isfile(self.file):
            raise NoResults(f"{path}: holds no results.h5; give the folder that 'mesogen run --output' wrote")
        try:
            self._file = _opened(self.file)
        except OSError as error:
            raise NoResults(f"{self.file}: cannot be read as HDF5 ({error})") from error
        if GROUP not in self._file and "observables" not in self._file:
            self._file.close()
            raise NoResults(f"{self.file}: is HDF5, but not the results of a Mesogen run (no group /{GROUP})")

    def close(self):
        """Close the file. Arrays already read stay valid."""
        self._file.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def __repr__(self):
        if not self._file:
            return f"<mesogen.Run {self.folder!r}, closed>"
        times = self.times
        span = f"{len(times)} frames to t = {times[-1]:g} {self.time_unit}" if len(times) else "no frames"
        return f"<mesogen.Run {self.folder!r}: {self.count} particles, {span}, fields {', '.join(self.fields)}>"

    # ---- the case -------------------------------------------------------------------------------------------------

    @property
    def case(self):
        """The resolved case file as text; every default is filled in."""
        return self._parameter("case") or ""

    @property
    def parameters(self):
        """The resolved case as nested dictionaries: run.parameters["physics"]["activity"]["activity"]."""
        try:
            return tomllib.loads(self.case)
        except tomllib.TOMLDecodeError as error:
            raise MesogenError(f"{self.file}: the stored case is not TOML: {error}") from error

    @property
    def title(self):
        """The title of the case, "" if it has none."""
        try:
            return str(self.parameters.get("title", ""))
        except MesogenError:
            return ""

    @property
    def version(self):
        """The version of Mesogen that made the results, "" if not stored."""
        return self._parameter("version") or ""

    @property
    def cost(self):
        """What the run took, as a Cost; None before its end."""
        group = self._file.get("parameters/cost")
        return None if group is None else Cost(*(group.attrs[name].item() for name in Cost._fields))

    @property
    def branched_from(self):
        """Where a run that `mesogen branch` started came from, as an Origin; None if the run began at its beginning."""
        group = self._file.get("parameters/branched_from")
        if group is None:
            return None
        folder, checkpoint, changes = (text.decode() if isinstance(text, bytes) else text for text in
                                       (group.attrs[name] for name in ("folder", "checkpoint", "changes")))
        return Origin(folder, checkpoint, float(group.attrs["time"]), int(group.attrs["step"]), changes.splitlines())

    def _parameter(self, name):
        group = self._file.get("parameters")
        if group is None:
            return None
        value = group.attrs[name] if name in group.attrs else group[name][()] if name in group else None
        return value.decode() if isinstance(value, bytes) else value

    @property
    def box(self):
        """Lengths of the box by axis (m), from the origin; shape (dimension,)."""
        edges = np.asarray(self._file[GROUP]["box"]["edges"], dtype=float)
        return np.diagonal(edges).copy() if edges.ndim == 2 else edges

    @property
    def periodic(self):
        """Whether the box is periodic, by axis; False where it ends at walls."""
        kinds = self._file[GROUP]["box"].attrs["boundary"]
        return tuple((kind.decode() if isinstance(kind, bytes) else str(kind)) == "periodic" for kind in kinds)

    # ---- particles ------------------------------------------------------------------------------------------------

    @property
    def fields(self):
        """Names of the stored particle fields, sorted."""
        group = self._file.get(GROUP, {})
        return sorted(name for name in group if name not in ("box", "id"))

    def _frames_of(self, name):
        group = self._file.get(GROUP, {})
        if name == "box" or name not in group:
            raise missing("field", name, self.fields, f"{self.file} (choose them with 'fields' in [output])")
        return group[name]

    def _clock(self, what, dtype):
        for name in ["position", *self.fields]:
            node = self._file.get(f"{GROUP}/{name}/{what}")
            if node is not None:
                return np.asarray(node, dtype=dtype)
        return np.zeros(0, dtype)

    @property
    def times(self):
        """Time of each stored frame (s)."""
        return self._clock("time", float)

    @property
    def steps(self):
        """Step number of each stored frame."""
        return self._clock("step", np.int64)

    @property
    def count(self):
        """Number of particles."""
        return next((self._frames_of(name)["value"].shape[1] for name in self.fields), 0)

    def frame_index(self, frame=-1):
        """The frame's number from 0; negative numbers count from the end. Raises NoSuchName when it is out of range."""
        count = len(self.times)
        if not -count <= frame < count:
            span = f"{self.file} holds {count} frames"
            raise NoSuchName(f"no frame {frame}; {span}, 0 to {count - 1}" if count else f"no frame {frame}; {span}")
        return frame % count

    def frame_at(self, time):
        """Number of the frame nearest to a time (s)."""
        self.frame_index(-1)
        return int(np.argmin(np.abs(self.times - time)))

    def field(self, name, frame=-1):
        """A particle field of one frame.

        Returns an array of shape (N,) for a scalar, (N, components) else; row i is the particle with the i-th smallest
        id, the same in every frame. The order tensor has the components (Q11, Q12) = q (cos 2 theta, sin 2 theta).
        """
        stored = self._frames_of(name)
        index = self.frame_index(frame)
        return np.asarray(stored["value"][index])

    def __getitem__(self, name):
        """The field at the last frame."""
        return self.field(name)

    def __contains__(self, name):
        return name in self.fields

    def unit(self, name):
        """Unit of a field, as text; "1" for numbers."""
        return stored_unit(self._frames_of(name)["value"])

    @property
    def length_unit(self):
        """Unit of lengths, as text: "m", or what the case says in [units]."""
        edges = self._file.get(f"{GROUP}/box/edges")
        return "m" if edges is None else stored_unit(edges, "m")

    @property
    def time_unit(self):
        """Unit of times, as text: "s", or what the case says in [units]."""
        for name in ["position", *self.fields]:
            times = self._file.get(f"{GROUP}/{name}/time")
            if times is not None:
                return stored_unit(times, "s")
        return "s"

    @property
    def id(self):
        """Particle ids in the order of the rows of every field, shape (N,)."""
        node = self._file.get(f"{GROUP}/id")
        if node is None:
            return np.arange(self.count)
        if isinstance(node, h5py.Group):
            node = node["value"]
        return np.asarray(node[0] if node.ndim == 2 else node)

    def director(self, frame=-1):
        """Director angle theta in (-pi/2, pi/2] (rad) and order q at each particle: a named pair (angle, order)."""
        order_tensor = self.field("order_tensor", frame)
        return nematics.director(order_tensor[:, 0], order_tensor[:, 1])

    # ---- observers ------------------------------------------------------------------------------------------------

    @property
    def observers(self):
        """What the observers recorded: {observer: [quantities]}, named as in the case."""
        group = self._file.get("observables", {})
        return {name: sorted(group[name]) for name in sorted(group)}

    def observer_of(self, *quantities):
        """Name of the first observer that recorded all these quantities, None if there is none."""
        return next((name for name, there in self.observers.items() if set(quantities) <= set(there)), None)

    def _recorded(self, observer, quantity):
        observers = self.observers
        if observer not in observers:
            raise missing("observer", observer, observers, self.file)
        if quantity not in observers[observer]:
            raise missing("quantity", quantity, observers[observer], f"observer '{observer}' of {self.file}")
        return self._file["observables"][observer][quantity]

    def series(self, observer, quantity):
        """Samples of a quantity over time.

        Returns (time, value): time of shape (T,) in s; value of shape (T,) for a scalar, (T, rows, columns) for a
        table. Tables of varying length (defects) are padded with NaN; see table().
        """
        recorded = self._recorded(observer, quantity)
        return np.asarray(recorded["time"], dtype=float), np.asarray(recorded["value"])

    def series_steps(self, observer, quantity):
        """Step number of each sample, shape (T,)."""
        return np.asarray(self._recorded(observer, quantity)["step"], dtype=np.int64)

    def series_unit(self, observer, quantity):
        """Unit of a recorded quantity, as text; "1" for numbers."""
        return stored_unit(self._recorded(observer, quantity)["value"])

    def table(self, observer, quantity, sample=-1):
        """One sample of a table without its padding, shape (rows, columns)."""
        recorded = self._recorded(observer, quantity)
        value = recorded["value"]
        if value.ndim != 3:
            raise MesogenError(f"quantity '{quantity}' of observer '{observer}' is no table; use series()")
        if not -len(value) <= sample < len(value):
            raise NoSuchName(f"no sample {sample} of '{quantity}'; observer '{observer}' holds {len(value)}")
        sample %= len(value)
        rows = value[sample]
        return rows[: int(recorded["count"][sample])] if "count" in recorded else rows


def _opened(file):
    """The file, opened as h5py does by default: HDF5 refuses a file that the process holds open with other locks.

    Without locks where that fails: the file system has none, or somebody here opened the file so. None is needed, since
    a run in progress replaces its results.h5 as a whole.
    """
    try:
        return h5py.File(file, "r")
    except OSError:
        return h5py.File(file, "r", locking=False)
