"""What is wrong with a sweep although each of its keys is right."""

import math

from ..units import time_unit
from .table_reader import nearest


def conflicts(sweep, seed_keys_given, own):
    """Problems as texts, each with its place in the sweep's file but without the file's name.

    seed_keys_given: whether the file has `seed_keys`. own: [common] of the file, without the changes of a study. A
    study may end runs before a quantity starts, since it takes its own means.
    """
    there = list(_keys(sweep.data))
    changed = {key for one in (sweep.common, *(point.values for point in sweep.points)) for key in one}
    yield from _of_seeds(sweep, changed, seed_keys_given)
    last = max((_end(sweep, own, point) for point in sweep.points), default=math.inf)
    observers = sorted({key.split(".")[1] for key in {*there, *changed} if key.startswith("observers.")})
    for number, quantity in enumerate(sweep.quantities, start=1):
        if quantity.observer not in observers:
            yield (f"quantity[{number}].series: {sweep.case} has no observer '{quantity.observer}'"
                   + nearest(quantity.observer, observers))
        if quantity.start >= last:
            unit = time_unit(sweep.data)
            yield (f"quantity[{number}].from: {quantity.start:g} {unit}, but no run goes on beyond 'time.end' = {last:g} "
                   f"{unit}")
    yield from _twice("quantity", [quantity.name for quantity in sweep.quantities], "give one of them another name")
    yield from _twice("point", [point.label for point in sweep.points],
                      "its runs would share a folder; leave one of them out, or name it in a [point.NAME]")


def _end(sweep, own, point):
    """time.end of a point, in the time unit of the case; infinity if it is no number, which mesogen refuses later."""
    time = sweep.data.get("time")
    in_case = time.get("end") if isinstance(time, dict) else None
    end = {"time.end": in_case, **own, **point.values}["time.end"]
    return end if isinstance(end, (int, float)) else math.inf


def _of_seeds(sweep, changed, given):
    if not sweep.seeds:
        if given:
            yield "seed_keys: means nothing without seeds"
        return
    for key in sweep.seed_keys:
        if key in changed:
            yield f"{key}: is set by the seeds; leave it out"


def _twice(what, names, advice):
    for name in dict.fromkeys(name for name in names if names.count(name) > 1):
        yield f"{what} '{name}' is there twice: {advice}"


def _keys(table, before=""):
    """All dotted keys of a case."""
    for key, value in table.items():
        if isinstance(value, dict):
            yield from _keys(value, before + key + ".")
        else:
            yield before + key
