"""Units as texts."""

import re
from collections.abc import Mapping

FACTOR = re.compile(r"([A-Za-z]+)([+-]\d+)?")


def plain(unit):
    """A unit of H5MD's module `units`, "kg m-3 s-1", as it is usually written, "kg/(m3 s)". Any other text stays."""
    above, below = [], []
    for factor in unit.split(" "):
        match = FACTOR.fullmatch(factor)
        if match is None:
            return unit
        power = int(match[2] or 1)
        (above if power > 0 else below).append(match[1] + (str(abs(power)) if abs(power) != 1 else ""))
    if not below:
        return " ".join(above)
    under = " ".join(below)
    return f"{' '.join(above) or '1'}/{f'({under})' if len(below) > 1 else under}"


def time_unit(case):
    """Of the times of a case, as it was read: "s", or what it says in [units]."""
    units = case.get("units")
    unit = units.get("time") if isinstance(units, Mapping) else None
    return unit if isinstance(unit, str) else "s"


def stored_unit(dataset, default="1"):
    """Of a dataset of results.h5, as it is usually written; of the columns of a table, "m, m, rad"."""
    unit = dataset.attrs.get("unit", dataset.attrs.get("unit_text", default))
    return plain(unit.decode() if isinstance(unit, bytes) else str(unit))
