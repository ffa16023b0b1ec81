"""The particles of a run: the fields of its stored frames, and the box."""

import h5py
import numpy as np

from . import nematics
from .errors import NoSuchName, missing
from .units import stored_unit

GROUP = "particles/fluid"  # where results.h5 holds the particles


class Frames:
    """The part of a Run that reads particles. The Run has `file`, its path, and `_file`, the open h5py.File."""

    @property
    def box(self):
        """Lengths of the box by axis, in length_unit; its origin is 0. Shape (dimension,)."""
        edges = np.asarray(self._file[GROUP]["box"]["edges"], dtype=float)
        return np.diagonal(edges).copy() if edges.ndim == 2 else edges

    @property
    def periodic(self):
        """Whether the box is periodic, by axis; False where it ends at walls."""
        kinds = self._file[GROUP]["box"].attrs["boundary"]
        return tuple((kind.decode() if isinstance(kind, bytes) else str(kind)) == "periodic" for kind in kinds)

    @property
    def length_unit(self):
        """Unit of lengths, as text: "m", or that of the case in [units]."""
        edges = self._file.get(f"{GROUP}/box/edges")
        return "m" if edges is None else stored_unit(edges, "m")

    @property
    def fields(self):
        """Names of the stored particle fields, sorted."""
        group = self._file.get(GROUP, {})
        return sorted(name for name in group if name not in ("box", "id"))

    @property
    def times(self):
        """Time of each stored frame, in time_unit."""
        return self._clock("time", float)

    @property
    def steps(self):
        """Step number of each stored frame."""
        return self._clock("step", np.int64)

    @property
    def id(self):
        """Particle ids in the order of the rows of every field, shape (N,)."""
        ids = self._ids()
        return np.arange(self.count) if ids is None else np.asarray(ids[0] if ids.ndim == 2 else ids)

    @property
    def count(self):
        """Number of particles, known also where no frame is stored."""
        ids = self._ids()
        if ids is not None:
            return ids.shape[-1]
        return next((self._field(name)["value"].shape[1] for name in self.fields), 0)

    def frame_index(self, frame=-1):
        """The number of a frame from 0; negative numbers count from the end. Raises NoSuchName out of range."""
        count = len(self.times)
        if not -count <= frame < count:
            span = f"{self.file} holds {count} frames"
            raise NoSuchName(f"no frame {frame}; {span}, 0 to {count - 1}" if count else f"no frame {frame}; {span}")
        return frame % count

    def frame_at(self, time):
        """The number of the frame nearest to a time, in time_unit. Raises NoSuchName if there is no frame."""
        self.frame_index(-1)
        return int(np.argmin(np.abs(self.times - time)))

    def field(self, name, frame=-1):
        """A particle field of one frame, in the unit that unit(name) gives. Raises NoSuchName for an unknown one.

        Returns an array of shape (N,) for a scalar, else (N, components). Row i is the particle with the i-th smallest
        id in every frame. The order tensor has the components (Q11, Q12) = q (cos 2 theta, sin 2 theta).
        """
        stored = self._field(name)
        return np.asarray(stored["value"][self.frame_index(frame)])

    def unit(self, name):
        """Unit of a field, as text; "1" for numbers."""
        return stored_unit(self._field(name)["value"])

    def director(self, frame=-1):
        """Director angle theta in (-pi/2, pi/2] (rad) and order q at each particle: a named pair (angle, order)."""
        order_tensor = self.field("order_tensor", frame)
        return nematics.director(order_tensor[:, 0], order_tensor[:, 1])

    def __getitem__(self, name):
        """The field at the last frame."""
        return self.field(name)

    def __contains__(self, name):
        """Whether a field of this name is stored."""
        return name in self.fields

    def _field(self, name):
        if name not in self.fields:
            raise missing("field", name, self.fields, f"{self.file} (choose them with 'fields' in [output])")
        return self._file[GROUP][name]

    def _clock(self, what, dtype):
        node = next(self._clocks(what), None)
        return np.zeros(0, dtype) if node is None else np.asarray(node, dtype=dtype)

    def _clocks(self, what):
        """The datasets of "time" or "step" of the fields that have them, which are alike."""
        nodes = (self._file.get(f"{GROUP}/{name}/{what}") for name in ("position", *self.fields))
        return (node for node in nodes if node is not None)

    def _ids(self):
        """The dataset of ids, None if there is none; an H5MD element has one row per frame."""
        node = self._file.get(f"{GROUP}/id")
        return node["value"] if isinstance(node, h5py.Group) else node
