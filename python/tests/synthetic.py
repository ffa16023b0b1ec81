"""Results of made-up runs, laid out as Mesogen writes them, whose content is known exactly."""

import os
import sys
import tempfile
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))

BOX = np.array([10.0, 5.0])
CELLS = (24, 12)
TIMES = [0.0, 1.0, 2.0]
STEPS = [0, 10, 20]
CASE = 'title = "Made up"\n[domain]\nsize = [10.0, 5.0]\n[physics.activity]\ntype = "active_stress"\nactivity = 0.05\n'


def lattice(cells=CELLS, box=BOX):
    """Positions of a lattice of particles, by id."""
    x, y = ((np.arange(n) + 0.5) * length / n for n, length in zip(cells, box))
    return np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)


def waves(position, number=1):
    """Velocity of a periodic flow without divergence, and its vorticity.

    Stream function a sin(kx) sin(ly): u = a l sin(kx) cos(ly), v = -a k cos(kx) sin(ly), w = a (k^2 + l^2) sin sin.
    """
    k, wave_l = 2 * np.pi * number / BOX
    x, y = k * position[:, 0], wave_l * position[:, 1]
    velocity = np.stack([wave_l * np.sin(x) * np.cos(y), -k * np.cos(x) * np.sin(y)], axis=1)
    return velocity, (k**2 + wave_l**2) * np.sin(x) * np.sin(y)


def order_tensor(position, frame=0):
    """Order 0.9, director at 0.1 frame + 0.3 sin(2 pi x / Lx); and that angle."""
    angle = 0.1 * frame + 0.3 * np.sin(2 * np.pi * position[:, 0] / BOX[0])
    return 0.9 * np.stack([np.cos(2 * angle), np.sin(2 * angle)], axis=1), angle


class Results:
    """Writes a results.h5."""

    def __init__(self, folder, name="results.h5"):
        os.makedirs(folder, exist_ok=True)
        self.folder = str(folder)
        self.path = os.path.join(self.folder, name)
        self.file = h5py.File(self.path, "w")
        self.file.create_group("h5md").attrs["version"] = [1, 1]
        fluid = self.file.create_group("particles/fluid")
        box = fluid.create_group("box")
        box.attrs["dimension"] = 2
        box.attrs["boundary"] = ["periodic", "periodic"]
        box["edges"] = BOX
        fluid["id"] = np.arange(len(lattice()))
        self.file.create_group("observables")
        parameters = self.file.create_group("parameters")
        parameters["case"], parameters["version"], parameters["seed"] = CASE, "0.1.0", 1

    def field(self, name, unit, frames):
        self._element(f"particles/fluid/{name}", unit, np.asarray(frames), STEPS, TIMES)

    def observable(self, observer, quantity, unit, samples, count=None, steps=STEPS, times=TIMES):
        element = self._element(f"observables/{observer}/{quantity}", unit, np.asarray(samples, float), steps, times)
        if count is not None:
            element["count"] = count

    def _element(self, path, unit, value, steps, times):
        element = self.file.create_group(path)
        element["step"], element["time"], element["value"] = steps[: len(value)], times[: len(value)], value
        element["value"].attrs["unit"] = unit
        return element

    def close(self):
        self.file.close()
        return self.folder


def complete(folder):
    """A run in which everything is stored."""
    results = Results(folder)
    position = lattice()
    results.field("position", "m", [position] * 3)
    results.field("velocity", "m/s", [(0.5 * f * waves(position)[0]).astype("f4") for f in range(3)])
    results.field("order_tensor", "1", [order_tensor(position, f)[0] for f in range(3)])
    results.field("colour", "1", [((position < BOX / 2).all(axis=1)).astype("f4")] * 3)
    for name, unit, samples in (
        ("v_rms", "m/s", [0, 0.1, 0.2]),
        ("density_min", "kg/m^3", [1, 0.99, 0.98]),
        ("density_max", "kg/m^3", [1, 1.01, 1.02]),
        ("total_momentum", "kg/s", np.zeros((3, 1, 2))),
    ):
        results.observable("stream", name, unit, samples)
    pad = [np.nan] * 4
    plus, minus = [2.0, 1.0, 0.5, 0.3], [7.0, 3.0, -0.5, -0.2]
    results.observable("knots", "defects", "m, m, 1, rad", [[pad, pad], [plus, minus], [pad, pad]], count=[0, 2, 0])
    for name, samples in (("count_plus", [0, 1, 0]), ("count_minus", [0, 1, 0]), ("total_charge", [0, 0, 0])):
        results.observable("knots", name, "1", samples)
    results.observable("tracers", "path", "m", [[[9.5, 1], [3, 3]], [[10.5, 1], [3, 2]], [[11.0, 1], [3, 1]]])
    results.observable("tracers", "distance", "m", [[[0], [0]], [[1], [1]], [[1.5], [2]]])
    results.observable("blend", "mixing_index", "1", [0, 0.1, 0.3])
    return results.close()


class FolderTest(unittest.TestCase):
    """A test with an empty folder of its own."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = os.path.join(holder.name, "run")

    def assert_text(self, error, *parts):
        for part in parts:
            self.assertIn(part, str(error.exception))
