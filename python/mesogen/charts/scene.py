"""A scene: a case, and its known result with the source of that.

    cases/accuracy/NAME/case.toml      an ordinary case
    cases/accuracy/NAME/answer.toml    the known result:

        title = "Shear wave"
        source = "exact: u decays as exp(-nu k^2 t)"
        across = 1.0              # m; resolution N means particles.spacing = across / N
        [[quantity]]
        series = "flow.v_rms"     # the observer's name in the case, and its quantity
        measure = "value"         # or another of measures.py
        at = [0.1, 0.2]           # s
        exact = [0.61, 0.52]      # in the unit of the series
        scale = 0.7               # optional: error = |value - exact| / scale; by default |exact|
"""

import os
from dataclasses import dataclass

from ..runs.check import unfit_series
from ..runs.table_reader import TableReader, read_toml
from ..units import time_unit
from .measures import MEASURES


@dataclass(frozen=True)
class Quantity:
    """One known result: the numbers `exact` that the measure must give for a series at the times `at`."""

    observer: str
    column: str
    measure: str
    at: tuple
    exact: tuple
    scale: float | None


@dataclass(frozen=True)
class Answer:
    """The known results of a scene. across: length in which a resolution counts particles, in the unit of the case."""

    file: str
    title: str
    source: str
    across: float
    quantities: tuple
    data: dict  # as it was read

    @property
    def last(self):
        """The last time of a known result, in the time unit of the case."""
        return max((at for quantity in self.quantities for at in quantity.at), default=0.0)

    def unfit(self, recorded):
        """Texts about quantities that a case will not record. recorded: see runs/check.py."""
        wanted = [(f"{self.file}: quantity[{number}].series", one.observer, one.column)
                  for number, one in enumerate(self.quantities, start=1)]
        return unfit_series(recorded, wanted, "an answer is about one number at a time")


@dataclass(frozen=True)
class Scene:
    """A case and its Answer, None if nothing is known."""

    case: str  # file
    data: dict  # the case as it was read
    answer: Answer | None

    @property
    def time_unit(self):
        """The unit of its times, for texts."""
        return time_unit(self.data)


def read_scene(path, problems, answer_required=True):
    """The Scene of a folder, or of a case file with the answer.toml beside it.

    Raises StudyError if a file cannot be read; what is wrong in the answer is added to `problems`.
    """
    folder, case = (path, os.path.join(path, "case.toml")) if os.path.isdir(path) else (os.path.dirname(path), path)
    answer = os.path.join(folder, "answer.toml")
    data = read_toml(case, "scene's case")
    known = answer_required or os.path.exists(answer)
    return Scene(case, data, read_answer(answer, problems) if known else None)


def read_answer(file, problems):
    """The Answer of an answer.toml; what is wrong in it is added to `problems`."""
    data = read_toml(file, "scene's answer")
    table = TableReader(data, file, problems)
    title, source = table.text("title"), table.text("source")
    across = table.number("across", above=0)
    quantities = tuple(_quantity(one) for one in table.tables("quantity"))
    table.finish()
    return Answer(file, title, source, across, quantities, data)


def _quantity(table):
    observer, column = table.series()
    measure = table.text("measure", choices=list(MEASURES))
    at = table.numbers("at", count=2 if measure == "growth_rate" else None)
    exact = table.numbers("exact", count=None if measure is None or at is None else MEASURES[measure].count(at))
    scale = table.number("scale", default=None, above=0)
    if exact is not None and scale is None and 0 in exact:
        table.refuse("exact", "is 0, so that the error cannot be relative to it: give a scale")
    table.finish()
    return Quantity(observer, column, measure, tuple(at or ()), tuple(exact or ()), scale)
