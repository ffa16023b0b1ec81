"""The points of a sweep, and their labels: names of folders that tell what a point changes."""

import itertools
import re
from dataclasses import dataclass

from .overrides import digest, read_overrides

LONGEST = 160  # characters of a label; a folder's name may have 255 bytes


@dataclass(frozen=True)
class Point:
    """One set of changes of the case, run once per seed. values: {"physics.activity.activity": 0.02}."""

    label: str
    values: dict


def grid_points(table):
    """Every combination of the lists of [grid]; the last key changes fastest. table: a TableReader."""
    axes = {}
    for key, values in read_overrides(table).items():
        if not isinstance(values, list) or not values:
            table.refuse(key, "must be a list of one or more values")
        else:
            axes[key] = values
    if not axes:
        return []
    names = short_names(list(axes))
    return [Point(_label(names, dict(zip(axes, combination, strict=True))), dict(zip(axes, combination, strict=True)))
            for combination in itertools.product(*axes.values())]


def named_points(table):
    """The points of the tables [point.NAME]. table: the TableReader of the sweep."""
    points = []
    for name, one in table.named_tables("point", required=False).items():
        if _safe(name) != name or not name.strip("."):
            table.problems.append(f"{one.place()}: the name is a folder's too: letters, digits, _ . + and - alone")
        if not one.data:
            table.problems.append(f"{one.place()}: changes nothing; give it keys of the case")
        points.append(Point(name, read_overrides(one)))
    return points


def short_names(keys):
    """{key: its shortest ending that no other of the keys has}: "activity" for "physics.activity.activity"."""
    def short(key):
        parts = key.split(".")
        for count in range(1, len(parts)):
            tail = ".".join(parts[-count:])
            if not any(other != key and ("." + other).endswith("." + tail) for other in keys):
                return tail
        return key

    return {key: short(key) for key in keys}


def value_word(value):
    """The value as part of a label: 0.02, quintic, 40.0x40.0."""
    if isinstance(value, list):
        return "x".join(value_word(member) for member in value)
    return str(value).lower() if isinstance(value, bool) else str(value)


def few(names):
    """For a message: the first three names, and how many more there are."""
    return ", ".join(names[:3]) + (f" and {len(names) - 3} more" if len(names) > 3 else "")


def _label(names, values):
    text = _safe("-".join(f"{names[key]}_{value_word(value)}" for key, value in values.items()))
    return text if len(text) <= LONGEST else f"{text[:LONGEST]}-{digest(values)}"


def _safe(text):
    return re.sub(r"[^A-Za-z0-9_.+-]", "_", text)
