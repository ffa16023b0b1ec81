"""A run to be broken off, and whether what it left is what the unbroken run has."""

import os
import sys

import h5py
import numpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "command"))
from small_case import CASE as SMALL  # noqa: E402

# Quick, but with all that a run writes: frames, samples, observers that remember, checkpoints all the time.
CHANGES = {"size = [1.6, 1.6]": "size = [3.2, 3.2]", "viscosity = 0.5": "viscosity = 0.1",
           "activity = 0.05": "activity = 0.3", "end = 0.1": "end = 6.0"}
CASE = SMALL.split("[observers.flow]")[0] + """\
[velocity]
type = "uniform"
value = [0.5, -0.3]
[observers.flow]
type = "flow_statistics"
interval = 0.1
[observers.defects]
type = "defects"
interval = 0.1
[observers.paths]
type = "pathlines"
interval = 0.1
[output]
interval = 0.2
checkpoint_interval = 0.02
[run]
precision = "single"
"""
for small, large in CHANGES.items():
    assert CASE.count(small) == 1, small
    CASE = CASE.replace(small, large)
FLUID = "particles/fluid"


def write_case(folder):
    path = os.path.join(folder, "case.toml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(CASE)
    return path


def read(folder):
    """All that results.h5 holds: {name: array} of the fields, the observers, and their steps."""
    def walk(group, name, found):
        for key, node in group.items():
            if isinstance(node, h5py.Dataset):
                found[name + key] = numpy.asarray(node)
            elif key != "parameters":
                walk(node, name + key + "/", found)
        return found

    with h5py.File(os.path.join(folder, "results.h5"), "r") as file:
        return walk(file, "", {})


def same(a, b):
    return numpy.array_equal(a, b, equal_nan=a.dtype.kind == "f")


def check_beginning(folder, whole):
    """Every frame and sample that is there is that of the unbroken run; returns the number of frames."""
    if not os.path.exists(os.path.join(folder, "results.h5")):
        frames = os.path.join(folder, "frames")
        assert not os.path.isdir(frames) or not [name for name in os.listdir(frames) if name.endswith(".h5")], \
            "there are frames, but no results.h5"
        return 0
    found = read(folder)
    for name, value in found.items():
        expected = whole[name]
        if name.startswith(FLUID + "/") and name.endswith(("/value", "/step", "/time")) or name.startswith("observables/"):
            expected = expected[:len(value)]
            if value.ndim == 3 and name.startswith("observables/"):  # padded to the most rows so far
                assert numpy.isnan(expected[:, value.shape[1]:]).all(), name
                expected = expected[:, :value.shape[1]]
        assert same(value, expected), f"{name} is not that of the unbroken run"
    for path in (os.path.join(folder, "frames", name) for name in os.listdir(os.path.join(folder, "frames"))
                 if name.endswith(".h5")) if os.path.isdir(os.path.join(folder, "frames")) else ():
        with h5py.File(path, "r") as frame:
            assert all(numpy.isfinite(numpy.asarray(node)).all() for node in frame.values()
                       if isinstance(node, h5py.Dataset)), path
    return len(found.get(FLUID + "/position/step", ()))


def check_complete(folder, whole):
    found = read(folder)
    assert found.keys() == whole.keys(), found.keys() ^ whole.keys()
    for name, expected in whole.items():
        assert same(expected, found[name]), f"{name} is not that of the unbroken run"
