"""Host against device in double precision, and the device against itself: the numbers that runs store."""

import importlib
import subprocess
import sys

from look import need_device
from place import EMULATED, scratch
from scenes import SCENES, command_of, has_code_for_cuda, scene
from verdicts import FAIL, NotRun

BOUND = 1e-10  # of the size of a field
STEPS = 100
NO_NUMBER = 1e300  # where a difference is no finite number
COMPARED = ("velocity", "order_tensor", "colour")


def need_hdf5():
    """Raises NotRun where Python cannot read results."""
    try:
        for module in ("numpy", "h5py"):
            importlib.import_module(module)
    except ImportError as error:
        raise NotRun(f"{sys.executable} has no {error.name}, which reading results needs: install numpy and h5py, or "
                     "name another Python by MESOGEN_PYTHON") from error


def agreement(place, out, report):
    """Runs each scene once on the host and twice on the device, and compares what the results and checkpoints hold."""
    need_device(out)
    need_hdf5()
    for name in SCENES:
        folder = scratch(out, name)
        problem = run_all(place, folder, name)
        if problem:
            report.line(name, FAIL, problem)
            continue
        flow = "incompressible" if name == "incompressible" else "wcsph"
        where = "" if has_code_for_cuda(place, flow) else f"; '{flow}' computes on the host in both"
        differences = relative_differences(folder / "host", folder / "device")
        largest = max(differences, key=differences.get)
        report.judge(f"{name}, host against device", differences[largest] <= BOUND,
                     f"largest difference {differences[largest]:.1e} of the field's size, in {largest} (bound "
                     f"{BOUND:.0e}){where}", **differences)
        changed = different_bits(folder / "device", folder / "again")
        told = f"other bits in {', '.join(changed[:5])}" if changed else "the same bits"
        report.judge(f"{name}, device twice", not changed, told, different=len(changed))


def run_all(place, folder, name):
    """The runs `host`, `device` and `again`. Returns what went wrong, or None."""
    settings = scene(name, 24 if EMULATED else 200, STEPS)
    for output, device in (("host", "cpu"), ("device", "cuda"), ("again", "cuda")):
        done = subprocess.run(command_of(place, folder, output, settings, device), cwd=folder, capture_output=True,
                              text=True, check=False)
        print(done.stdout + done.stderr, flush=True)
        if done.returncode:
            told = (done.stderr.strip() or "it wrote nothing").splitlines()[-1]
            return f"the run `{output}`, run.device = \"{device}\", ended with exit code {done.returncode}: {told}"
        log = (folder / output / "run.log").read_text(encoding="utf-8")
        if device == "cuda" and "computing on " not in log:
            return f"the run `{output}` did not compute on the device"
    return None


def relative_differences(one, other):
    """{field: largest difference over the size of the field} of all frames. The size is the largest deviation from the
    mean, so a mean flow hides nothing. `path` is position and image together: a particle at a face may be on either
    side."""
    import h5py
    import numpy
    found = {}
    with h5py.File(one / "results.h5", "r") as first, h5py.File(other / "results.h5", "r") as second:
        box = numpy.asarray(first["particles/fluid/box/edges"])

        def values(file, field):
            fluid = file["particles/fluid"]
            if field == "path":
                return fluid["position/value"][:] + fluid["image/value"][:] * box
            return fluid[f"{field}/value"][:]

        for field in ("path", *(name for name in COMPARED if name in first["particles/fluid"])):
            found[field] = relative_difference(values(first, field), values(second, field))
    return found


def relative_difference(a, b):
    """Of two arrays frames x particles (x components)."""
    import numpy
    if a.shape != b.shape:
        return NO_NUMBER
    size = numpy.abs(a - a.mean(axis=1, keepdims=True)).max()
    difference = numpy.abs(a - b).max() / size if size > 0 else numpy.inf
    return float(difference) if numpy.isfinite(difference) else NO_NUMBER


def numbers_of(file):
    """{name: values} of all that a file stores of particles and observers. What a run cost is no dataset."""
    import h5py
    found = {}
    with h5py.File(file, "r") as opened:
        def keep(name, item):
            if isinstance(item, h5py.Dataset) and item.dtype.kind in "iuf":
                found[name] = item[()]
        opened.visititems(keep)
    return found


def different_bits(one, other):
    """Names of the datasets of results and checkpoints whose bits differ, or that only one of two runs has."""
    changed = []
    for file in ("results.h5", "checkpoint_a.h5", "checkpoint_b.h5"):
        first, second = (numbers_of(run / file) if (run / file).exists() else {} for run in (one, other))
        for name in sorted(first.keys() | second.keys()):
            if name not in first or name not in second or first[name].tobytes() != second[name].tobytes():
                changed.append(f"{file}:/{name}")
    return changed
