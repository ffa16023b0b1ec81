"""Whether a run held, and if not, which bound it broke first.

The judge looks at the series of the observer flow_statistics, at what stopped the run, and at the answer:

    stopped    mesogen stopped the run: a number is not finite, or a guard; or the timeout of the study did
    clumping   smallest distance of two particles, in spacings: below the bound
    volume     a particle's volume over that of the start, minus 1: beyond the bound
    density    a particle's density over that of the start, minus 1: beyond the bound
    energy     kinetic energy over that of the start, minus 1: above the bound; only for flows that nothing drives
    order      mean order of the nematic, change from the start: beyond the bound
    momentum   change of the total momentum over mass x largest rms speed: above the bound
    error      relative error against the answer (measures.py): above the bound
"""

import re
from dataclasses import dataclass, fields

import numpy as np

from ..errors import MesogenError, StudyError
from ..samples import observer_of
from . import measures


@dataclass(frozen=True)
class Bounds:
    """The bounds of a study; None: no bound."""

    clumping: float | None = 0.3
    volume: float | None = 0.05
    density: float | None = 0.03
    energy: float | None = None
    momentum: float | None = 0.01
    order: float | None = None
    error: float | None = 0.2
    after: float = 0.0  # earlier samples do not count, in the time unit of the case


CRITERIA = tuple(field.name for field in fields(Bounds) if field.name != "after")
NEEDED = ("v_rms", "kinetic_energy", "total_momentum", "density_min", "density_max", "volume_min", "volume_max",
          "min_spacing")


@dataclass(frozen=True)
class Verdict:
    """How a run ended. how: "" if it held, else the bound that it broke first, at `time`; reason: in words."""

    how: str
    time: float
    reason: str
    extremes: dict  # {criterion: its worst number}

    @property
    def holds(self):
        return not self.how


def read_bounds(table, has_answer):
    """The Bounds of the table [judge] of a study: for each a number, or false."""
    found = {}
    for name in CRITERIA:
        if table.data.get(name) is False:
            table.known.append(name)
            found[name] = None
        else:
            found[name] = table.number(name, getattr(Bounds, name), above=0)
    if not has_answer:
        if isinstance(table.data.get("error"), float):
            table.refuse("error", "there is no answer.toml beside the case to compare with; leave it out")
        found["error"] = None
    found["after"] = table.number("after", 0.0)
    return Bounds(**found)


NO_FLOW = "the case has no observer of type flow_statistics, by which runs are judged; add one to the case"
NO_ORDER = ("[judge] has a bound of the order, but the case has no observer of type nematic_statistics; add one to the "
            "case")


def unfit_to_judge(recorded, bounds):
    """Texts about what the observers of a case do not record but the judge needs. recorded: see runs/check.py."""
    if observer_of(recorded, NEEDED) is None:
        yield NO_FLOW
    if bounds.order is not None and observer_of(recorded, ["mean_order"]) is None:
        yield NO_ORDER


def judge(run, bounds, quantities=(), stopped=""):
    """The Verdict on a run.

    run: mesogen.Run; quantities: of the answer; stopped: the first line of its error, "" if it ran to its end.
    Raises StudyError if the run has no observer flow_statistics.
    """
    observer = run.observer_of(*NEEDED)
    if observer is None:
        raise StudyError(NO_FLOW)
    time = run.series(observer, "v_rms")[0]
    curves = _curves(lambda name: run.series(observer, name)[1])
    if bounds.order is not None:
        curves["order"] = _order(run, time)
    looked = time >= bounds.after
    failures, extremes = [], {}
    for name, curve in curves.items():
        bound = getattr(bounds, name)
        shown = curve[looked]
        if bound is None or np.isnan(shown).all():
            continue
        low = name == "clumping"
        extremes[name] = float(np.nanmin(shown) if low else np.nanmax(shown))
        beyond = looked & ((curve < bound) if low else (curve > bound))
        if beyond.any():
            first = int(np.argmax(beyond))
            failures.append((float(time[first]), name, _words(name, float(curve[first]), bound)))
    if stopped:
        failures.append((stop_time(stopped, time), way_of(stopped), stopped))
    elif bounds.error is not None and quantities:
        extremes["error"] = _error(run, quantities)
        if not extremes["error"] <= bounds.error:
            at = max(at for quantity in quantities for at in quantity.at)
            failures.append((at, "error", _words("error", extremes["error"], bounds.error)))
    if not failures:
        return Verdict("", float("nan"), "", extremes)
    at, how, reason = min(failures, key=lambda failure: failure[0])
    return Verdict(how, at, reason, extremes)


def _error(run, quantities):
    try:
        return measures.error(run, quantities)
    except measures.Vanished:
        return float("inf")
    except MesogenError as error:
        raise StudyError(f"the answer does not fit the case: {error}") from error


def _curves(series):
    """{criterion: its number over time}; NaN if the scene has no such field."""
    def spread(name):
        low, high = series(name + "_min"), series(name + "_max")
        start = np.sqrt(low[0] * high[0])
        return np.maximum(high / start - 1.0, 1.0 - low / start)

    speed, energy = series("v_rms"), series("kinetic_energy")
    momentum = series("total_momentum").reshape(len(speed), -1)
    fastest = np.nanmax(speed, initial=0.0)
    with np.errstate(invalid="ignore", divide="ignore"):
        mass = np.nanmedian(2.0 * energy / speed**2) if fastest > 0 else np.nan
        return {
            "clumping": series("min_spacing"),
            "volume": spread("volume"),
            "density": spread("density"),
            "energy": energy / energy[0] - 1.0 if energy[0] > 0 else np.full(len(speed), np.nan),
            "momentum": np.linalg.norm(momentum - momentum[0], axis=1) / (mass * fastest),
        }


def _order(run, time):
    """Change of the mean order from the start, at these times."""
    observer = run.observer_of("mean_order")
    if observer is None:
        raise StudyError(NO_ORDER)
    own_time, order = run.series(observer, "mean_order")
    return np.abs(np.interp(time, own_time, order) - order[0])


def _words(name, value, bound):
    """A broken bound in words."""
    percent = f"{100 * value:.3g} %, more than {100 * bound:g} %"
    return {
        "clumping": f"two particles are {value:.2g} spacings apart, less than {bound:g}",
        "volume": f"a particle's volume has changed by {percent}",
        "density": f"a particle's density has changed by {percent}",
        "energy": f"the kinetic energy has grown by {percent}",
        "order": f"the mean order has changed by {value:.3g}, more than {bound:g}",
        "momentum": f"the fluid has drifted by {percent} of its speed",
        "error": f"it is wrong by {percent}",
    }[name]


# What stops a run, by words of its error (framework/run/guard.cpp).
WAYS = (
    ("NaN", "is not finite"),
    ("ran away", "ran away"),
    ("compression", "'compression' is"),
    ("void", "left a void"),
    ("gathering", "have gathered"),
    ("pair", "spacings apart, less than"),
    ("too slow", "took longer than"),
)


def way_of(stopped):
    """The short name of what stopped a run, from the first line of its error."""
    return next((name for name, words in WAYS if words in stopped), "stopped")


def stop_time(stopped, times):
    """When a run was stopped: the time in its error, else that of its last sample."""
    said = re.search(r" at t = ([-+.\deE]+) ", stopped)
    return float(said[1]) if said else float(times[-1]) if len(times) else 0.0
