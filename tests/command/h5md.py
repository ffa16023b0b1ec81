"""The rules of H5MD 1.1 and of its module `units` 1.0, as far as they concern a file without connectivity.

From the specification, https://www.nongnu.org/h5md/h5md.html and https://www.nongnu.org/h5md/modules/units.html.
problems(file) lists what breaks them, nothing if the file keeps to all.
"""

import re

import h5py
import numpy

STANDARD = {"position": "vector", "image": "vector", "velocity": "vector", "force": "vector", "mass": "scalar",
            "id": "scalar", "species": "scalar", "charge": "scalar"}
BASE = "m g s A K mol cd rad sr Hz N Pa J W C V F ohm S Wb T H degC lm lx Bq Gy Sv kat".split()
PREFIXES = ["", *"E P T G M k h da d c m u n p f a".split()]
SYMBOLS = {prefix + symbol for prefix in PREFIXES for symbol in BASE}


def problems(file):
    found = []
    with h5py.File(file, "r") as root:
        _Rules(root, found).check()
    return found


class _Rules:
    def __init__(self, root, found):
        self.root, self.found = root, found

    def check(self):
        self.metadata()
        for group in self.group(self.root, "particles", required=False).values():
            self.particles(group)
        self.observables(self.group(self.root, "observables", required=False))
        parameters = self.root.get("parameters")
        self.expect(parameters is None or isinstance(parameters, h5py.Group), "parameters", "must be a group")

    def expect(self, holds, where, rule):
        if not holds:
            self.found.append(f"{where}: {rule}")
        return bool(holds)

    def group(self, parent, name, required=True):
        node = parent.get(name)
        if node is None and not required:
            return {}
        there = self.expect(isinstance(node, h5py.Group), f"{getattr(parent, 'name', '').rstrip('/')}/{name}", "must be a group")
        return node if there else {}

    # ---- the group h5md -------------------------------------------------------------------------------------------

    def metadata(self):
        h5md = self.group(self.root, "h5md")
        self.version(h5md, [1, 1])
        self.fixed_text(self.group(h5md, "author"), "name")
        self.fixed_text(self.group(h5md, "author"), "email", required=False)
        for name in ("name", "version"):
            self.fixed_text(self.group(h5md, "creator"), name)
        modules = self.group(h5md, "modules")
        units = self.group(modules, "units")
        self.version(units, [1, 0])
        self.expect(self.fixed_text(units, "system") == "SI", "h5md/modules/units", "the units are of the SI")

    def version(self, group, expected):
        attribute = self.attribute(group, "version")
        if attribute is None:
            return
        self.expect(attribute.dtype.kind in "iu" and attribute.shape == (2,), f"{group.name}@version",
                    "must be two integers")
        self.expect(list(group.attrs["version"]) == expected, f"{group.name}@version", f"must be {expected}")

    def attribute(self, node, name, required=True):
        """Its identifier, which tells type and shape; None if it is not there."""
        if name in getattr(node, "attrs", {}):
            return node.attrs.get_id(name)
        self.expect(not required, f"{getattr(node, 'name', '?')}@{name}", "is missing")
        return None

    def fixed_text(self, node, name, shape=(), required=True):
        """A text attribute of fixed length and this shape, decoded; None if it is not there."""
        attribute = self.attribute(node, name, required)
        if attribute is None:
            return None
        kind, where = attribute.get_type(), f"{node.name}@{name}"
        if not self.expect(isinstance(kind, h5py.h5t.TypeStringID), where, "must be a string"):
            return None
        self.expect(not kind.is_variable_str(), where, "must be a string of fixed length")
        self.expect(attribute.shape == shape, where, f"must have the shape {shape}")
        value = node.attrs[name]
        return value.decode() if isinstance(value, bytes) else value

    # ---- elements -------------------------------------------------------------------------------------------------

    def element(self, node):
        """The dataset of the values of an H5MD element, and whether it depends on time."""
        if isinstance(node, h5py.Dataset):
            self.unit(node)
            return node, False
        value, step = node.get("value"), node.get("step")
        where = node.name
        if not self.expect(isinstance(value, h5py.Dataset) and isinstance(step, h5py.Dataset), where,
                           "an element needs the datasets step and value"):
            return None, True
        self.expect(step.dtype.kind in "iu", where, "step must be of integers")
        self.expect(step.ndim == 1 and value.ndim >= 1 and len(step) == len(value), where,
                    "step must have one number for each sample of value")
        self.expect((numpy.diff(step[:]) > 0).all(), where, "step must increase")
        if "time" in node:
            time = node["time"]
            self.expect(time.dtype.kind in "iuf" and time.shape == step.shape, where, "time must be like step")
            self.expect((numpy.diff(time[:]) > 0).all(), where, "time must increase")
            self.unit(time)
        self.unit(value)
        return value, True

    def unit(self, dataset):
        """The attribute `unit` by the module: a sequence of factors with signed powers; ASCII, fixed length, scalar."""
        text = self.fixed_text(dataset, "unit", required=False)
        if text is None:
            return
        where = f"{dataset.name}@unit = '{text}'"
        self.expect(dataset.attrs.get_id("unit").get_type().get_cset() == h5py.h5t.CSET_ASCII, where, "must be ASCII")
        seen = []
        for number, factor in enumerate(text.split(" ")):
            if re.fullmatch(r"\d+(\.\d+)?([+-]\d+)?", factor):
                self.expect(number == 0, where, "a number must be the first factor")
                continue
            match = re.fullmatch(r"([A-Za-z]+)([+-]\d+)?", factor)
            if self.expect(match, where, f"'{factor}' is no unit factor"):
                self.expect(match[1] in SYMBOLS, where, f"'{match[1]}' is no symbol of the SI")
                self.expect(match[2] is None or int(match[2]) != 0, where, "a power must not be 0")
                seen.append(match[1])
        self.expect(len(set(seen)) == len(seen), where, "a symbol may stand once")

    # ---- particles and observables ----------------------------------------------------------------------------------

    def particles(self, group):
        box = self.group(group, "box")
        dimension = self.attribute(box, "dimension")
        if dimension is None:
            return
        self.expect(dimension.dtype.kind in "iu" and dimension.shape == (), box.name, "dimension must be one integer")
        axes = int(box.attrs["dimension"])
        self.fixed_text(box, "boundary", shape=(axes,))
        kinds = {kind.decode() if isinstance(kind, bytes) else kind for kind in box.attrs.get("boundary", ())}
        self.expect(kinds <= {"periodic", "none"}, box.name, f"boundary {kinds} must be periodic or none")
        if "edges" in box or kinds != {"none"}:
            edges, in_time = self.element(box["edges"])
            self.expect(edges.dtype.kind in "iuf" and edges.shape[in_time:] in ((axes,), (axes, axes)), box.name,
                        "edges must be a vector or a matrix")
            self.expect(not in_time or "position" in group and box["edges/step"] == group["position/step"], box.name,
                        "its step must be that of the position")
        counts = set()
        for name, node in group.items():
            if name == "box":
                continue
            value, in_time = self.element(node)
            if value is None:
                continue
            counts.add(value.shape[in_time])
            rank = STANDARD.get(name)
            shape = {"vector": (axes,), "scalar": ()}.get(rank, value.shape[in_time + 1:])
            self.expect(value.shape[in_time + 1:] == shape, node.name, f"must be a {rank} for each particle")
            self.expect(value.dtype.kind in ("iu" if name == "id" else "iuf"), node.name, "is of another type")
        self.expect(len(counts) <= 1, group.name, "all elements must be of as many particles")
        if "image" in group and self.expect("position" in group, group.name, "image needs position"):
            for name in ("step", "time"):
                self.expect(group["image"][name] == group["position"][name], f"{group.name}/image/{name}",
                            "must be a hard link to that of the position")
        if "id" in group:
            identity = self.element(group["id"])[0]
            self.expect(len(numpy.unique(identity)) == identity.size, group.name, "id must be unique")

    def observables(self, group):
        """Elements, or groups of such."""
        for node in group.values():
            if isinstance(node, h5py.Group) and "value" not in node:
                self.observables(node)
            else:
                self.element(node)
