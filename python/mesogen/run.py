"""The results of a finished or running simulation, read from its results.h5."""

import os
import tomllib
from collections import namedtuple
from itertools import chain

import h5py

from . import frames, samples
from .errors import MesogenError, NoResults
from .frames import Frames
from .samples import Samples
from .units import stored_unit

# The cost of a finished run, over all its sessions: steps; sessions (above 1: it was resumed); wall_seconds of
# stepping, without start-up; cpu_seconds of all threads; threads of the last session; peak_memory (resident, bytes).
Cost = namedtuple("Cost", "steps sessions wall_seconds cpu_seconds threads peak_memory")

# Where a branch started: folder of the other run, name of its checkpoint, time and step of that, and the changes of the
# case, a list of "key=value".
Origin = namedtuple("Origin", "folder checkpoint time step changes")


def open(path):
    """Open the results of a run.

    path: the run's folder, its results.h5, or the replay.h5 that `mesogen replay` wrote.
    Returns a Run. Raises NoResults if there are none that can be read.

    >>> run = mesogen.open("output/quickstart")
    >>> run.fields
    ['image', 'order_tensor', 'position', 'velocity']
    >>> velocity = run["velocity"]             # last frame, N x 2, in m/s, ordered by particle id
    >>> time, v_rms = run.series("flow", "v_rms")
    """
    return Run(path)


class Run(Frames, Samples):
    """The results of one run. Use as a context manager, or call close() when done.

    Arrays are numpy arrays; particle rows are ordered by particle id; numbers are in the units of the case: lengths in
    `length_unit`, m by default, times in `time_unit`, s by default.
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
        if frames.GROUP not in self._file and samples.GROUP not in self._file:
            self._file.close()
            raise NoResults(f"{self.file}: is HDF5, but not the results of a Mesogen run (no group /{frames.GROUP})")

    def close(self):
        """Close the file. Arrays already read stay valid."""
        self._file.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def __repr__(self):
        name = self.folder if os.path.basename(self.file) == "results.h5" else self.file
        if not self._file:
            return f"<mesogen.Run {name!r}, closed>"
        times = self.times
        span = f"{len(times)} frames to t = {times[-1]:g} {self.time_unit}" if len(times) else "no frames"
        contents = (("fields", self.fields), ("observers", self.observers))
        stored = [f"{what} {', '.join(names)}" for what, names in contents if names]
        return f"<mesogen.Run {name!r}: {'; '.join([f'{self.count} particles, {span}', *stored])}>"

    @property
    def case(self):
        """The case as TOML text, with all defaults filled in."""
        return self._parameter("case") or ""

    @property
    def parameters(self):
        """The case as nested dictionaries: run.parameters["physics"]["activity"]["activity"]."""
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
        """The version of Mesogen that made the results, "" if it is not stored."""
        return self._parameter("version") or ""

    @property
    def cost(self):
        """The Cost of the run, None before its end."""
        group = self._file.get("parameters/cost")
        return None if group is None else Cost(*(group.attrs[name].item() for name in Cost._fields))

    @property
    def branched_from(self):
        """The Origin of a run that `mesogen branch` started, None for other runs."""
        group = self._file.get("parameters/branched_from")
        if group is None:
            return None
        folder, checkpoint, changes = (text.decode() if isinstance(text, bytes) else text for text in
                                       (group.attrs[name] for name in ("folder", "checkpoint", "changes")))
        return Origin(folder, checkpoint, float(group.attrs["time"]), int(group.attrs["step"]), changes.splitlines())

    @property
    def time_unit(self):
        """Unit of times, as text: "s", or that of the case in [units]."""
        clock = next(chain(self._clocks("time"), self._sample_clocks()), None)
        return "s" if clock is None else stored_unit(clock, "s")

    def _parameter(self, name):
        group = self._file.get("parameters")
        if group is None:
            return None
        value = group.attrs[name] if name in group.attrs else group[name][()] if name in group else None
        return value.decode() if isinstance(value, bytes) else value


def _opened(file):
    """The file, opened with the default locks of h5py: HDF5 refuses a file that this process holds open with others.

    If that fails, it is opened without locks: the file system has none, or this process opened the file without. Locks
    are not needed, since a run in progress replaces its results.h5 as a whole.
    """
    try:
        return h5py.File(file, "r")
    except OSError:
        return h5py.File(file, "r", locking=False)
