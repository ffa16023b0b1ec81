"""A study of kind "stability" as a TOML file:

    title = "Sound speed"
    kind = "stability"
    scene = "../../cases/accuracy/taylor_green" # a folder with case.toml, or a case file; relative to this file
    end = 0.4                                   # s of simulated time per run
    timeout = 60                                # s of wall time per run, optional
    threads = 1
    remedy = "..."                              # optional: what avoids the failure, for the table
    [common]                                    # optional: changed in all runs
    "particles.spacing" = 0.04
    [sweep]
    key = "physics.flow.sound_speed"            # the parameter that is searched
    from = 2.0
    to = 50.0
    scale = "log"                               # or "linear"
    tolerance = 0.05                            # of the boundary: relative (log), or in the key's unit (linear)
    points = 2                                  # optional: number of values that are tried first; 2: the ends
    template = "[{}, 1.0]"                      # optional: the value of the key; {} is the number
    name = "sound speed (m/s)"                  # optional: for the axis
    [across]                                    # optional: a second parameter
    key = "physics.flow.viscosity"
    values = [0.01, 0.1]
    name = "viscosity (Pa s)"
    [judge]                                     # optional: bounds, see judge.py; false: no bound
    volume = 0.2
    energy = 0.05
    [variant.default]                           # or in files that studies share, see parts.py
    [variant.no_shift]
    "physics.flow.shift" = 0.0
"""

import tomllib
from dataclasses import asdict, dataclass

from ..errors import StudyError
from ..runs.overrides import digest, is_value, read_overrides
from ..runs.table_reader import TableReader, is_number
from .judge import Bounds, read_bounds
from .parts import Study, Variant, read_common
from .search import Sweep


@dataclass(frozen=True)
class Cell:
    """One search: a variant at one value of the second parameter, None if there is no such parameter."""

    variant: Variant
    across: object

    @property
    def name(self):
        return self.variant.name + ("" if self.across is None else f", {self.across}")


@dataclass(frozen=True)
class StabilityStudy(Study):
    """A stability study. end: simulated time per run; sweep: range of the parameter; template: of its values."""

    end: float
    remedy: str
    sweep: Sweep
    sweep_key: str
    sweep_name: str
    template: str
    across_key: str | None
    across_name: str
    across_values: tuple
    bounds: Bounds

    def cells(self):
        """The searches of the study."""
        return [Cell(variant, value) for variant in self.variants for value in self.across_values or (None,)]

    def overrides(self, cell, value):
        """What the run of a cell at a value of the searched parameter changes in the case."""
        swept = tomllib.loads("value = " + self.template.replace("{}", repr(value)))["value"]
        across = {} if cell.across is None else {self.across_key: cell.across}
        return {"time.end": self.end, **self.common, **cell.variant.overrides, **across, self.sweep_key: swept}

    def key(self, cell, value):
        """A digest of all that the run of a cell at a value depends on."""
        answer = self.scene.answer.data if self.scene.answer else None
        return digest(self.scene.data, answer, self.overrides(cell, value), asdict(self.bounds), self.threads)


def read_stability_study(file, data):
    """The study. data: of the file. Raises StudyError with all problems."""
    problems = []
    table = TableReader(data, file, problems)
    common = read_common(table, False, _variant)
    scene, variants = common["scene"], common["variants"]
    end, remedy = table.number("end", above=0), table.text("remedy", "")
    sweep_table = table.table("sweep", required=True)
    sweep_key, sweep = _sweep(sweep_table)
    sweep_name, template = sweep_table.text("name", sweep_key or ""), _template(sweep_table)
    sweep_table.finish()
    across_key, across_name, values = _across(table.table("across")) if "across" in table else (None, "", ())
    judge_table = table.table("judge")
    table.finish()
    bounds = read_bounds(judge_table, scene is not None and scene.answer is not None)
    judge_table.finish()
    if end is not None and bounds.error is not None and end < scene.answer.last:
        problems.append(f"{table.place('end')}: the scene's answer is for t = {scene.answer.last:g} {scene.time_unit}; "
                        "run to there, or say error = false in [judge]")
    for variant in variants:
        for key in {sweep_key, across_key} & set(variant.overrides):
            problems.append(f"{file}: variant.{variant.name}.\"{key}\": is swept; leave it out")
    if problems:
        raise StudyError(problems)
    return StabilityStudy(**common, end=end, remedy=remedy, sweep=sweep, sweep_key=sweep_key, sweep_name=sweep_name,
                          template=template, across_key=across_key, across_name=across_name, across_values=values,
                          bounds=bounds)


def _sweep(table):
    key, scale = table.text("key"), table.text("scale", "linear", choices=["linear", "log"])
    first, last = table.number("from"), table.number("to")
    tolerance, points = table.number("tolerance", above=0), table.integer("points", 2, at_least=2)
    if None in (first, last, tolerance, points):
        return key, None
    if first == last:
        table.refuse("to", "is the same as from")
    if scale == "log" and (first <= 0 or last <= 0):
        table.refuse("scale", 'a "log" scale needs from and to above 0')
    return key, Sweep(float(first), float(last), scale == "log", tolerance, points)


def _template(table):
    text = table.text("template", "{}")
    try:
        fits = text.count("{}") == 1 and is_value(tomllib.loads("value = " + text.replace("{}", "1.0"))["value"])
    except tomllib.TOMLDecodeError:
        fits = False
    if not fits:
        table.refuse("template", "must be a value of TOML with one {} where the number goes, such as \"[{}, 1.0]\"")
    return text


def _across(table):
    key = table.text("key")
    values = table.data.get("values")
    table.known.append("values")
    if not isinstance(values, list) or not values or not all(is_number(v) or isinstance(v, str) for v in values):
        table.refuse("values", "must be a list of one or more numbers or texts")
        values = []
    name = table.text("name", key or "")
    table.finish()
    return key, name, tuple(values)


def _variant(name, table):
    return Variant(name, read_overrides(table, ("note",)), table.text("note", ""))
