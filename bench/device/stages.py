"""The stages of scripts/device in order: name, time limit in seconds, function(place, out, report)."""

import typing

from agreement import agreement
from counters import counters
from look import look
from programs import command_tests, device_passes, sanitizer
from roofline import roofline
from speed_stages import large_speed, largest_speed, speed


class Stage(typing.NamedTuple):
    name: str
    seconds: float
    run: typing.Callable
    about: str


STAGES = [
    Stage("look", 20, look, "the driver, the card, copies, starts of kernels"),
    Stage("passes", 15, device_passes, "pair sums on the device against those on the host"),
    Stage("memcheck", 60, sanitizer("memcheck"), "compute-sanitizer: accesses beyond arrays"),
    Stage("initcheck", 60, sanitizer("initcheck"), "compute-sanitizer: values that nobody wrote"),
    Stage("tests", 120, command_tests, "tests/command/test_device.py"),
    Stage("agreement", 60, agreement, "host against device, device twice, in double precision"),
    Stage("speed", 90, speed, "500 x 500 and 1000 x 1000 particles, incompressible"),
    Stage("large", 90, large_speed, "3162 x 3162 particles"),
    Stage("roofline", 20, roofline, "sums over neighbours against the peak of the device"),
    Stage("counters", 90, counters, "Nsight Compute over the sums over neighbours"),
    Stage("largest", 150, largest_speed, "10,000 x 10,000 particles"),
]
LIMIT = 570  # s, for all stages


def stage(name):
    return next(one for one in STAGES if one.name == name)
