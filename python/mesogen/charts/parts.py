"""What both kinds of study have: a scene, variants of its case, and the ledger runs.csv.

Variants are tables [variant.NAME] of the study itself, and of files that studies share:

    variants_from = ["variants/flow.toml"]      # relative to the study; such a file holds tables [variant.NAME] only
"""

import dataclasses
import os

from ..errors import StudyError
from ..runs.ledger import Ledger
from ..runs.overrides import read_overrides
from ..runs.table_reader import TableReader, nearest, read_toml
from .scene import Scene, read_scene


@dataclasses.dataclass(frozen=True)
class Variant:
    """A variant of the case: what it changes. note: for the table. resolutions: of an accuracy study."""

    name: str
    overrides: dict
    note: str
    resolutions: tuple = ()


@dataclasses.dataclass(frozen=True)
class Study:
    """A study of either kind. timeout: s of wall time per run, or None; common: overrides of all runs."""

    file: str
    title: str
    scene: Scene
    threads: int
    timeout: float | None
    common: dict
    variants: tuple


def read_common(table, answer_required, read_variant):
    """{field: value} of a Study. table: of the file; read_variant: function of the name and table of a variant."""
    table.text("kind")
    return {"file": table.file, "title": table.text("title"), "scene": scene_of(table, answer_required),
            "threads": table.integer("threads", 1), "timeout": table.number("timeout", default=None, above=0),
            "common": read_overrides(table.table("common")),
            "variants": tuple(read_variant(name, one) for name, one in variant_tables(table).items())}


def ledger_of(folder, columns):
    """The Ledger of a study's folder."""
    return Ledger(os.path.join(folder, "runs.csv"), columns)


def only(study, names):
    """The study with only these variants; with all of them if `names` is empty. Raises StudyError."""
    known = [variant.name for variant in study.variants]
    for name in names:
        if name not in known:
            raise StudyError(f"--only: no variant '{name}' in {study.file}{nearest(name, known)}")
    return dataclasses.replace(study, variants=tuple(v for v in study.variants if not names or v.name in names))


def scene_of(table, answer_required):
    """The Scene that the study names, None if it cannot be read."""
    place = table.text("scene")
    if place is None:
        return None
    try:
        return read_scene(table.beside(place), table.problems, answer_required)
    except StudyError as error:
        table.problems += [f"{table.place('scene')}: {problem}" for problem in error.problems]
        return None


def variant_tables(table):
    """{name: TableReader} of the study's variants; those of shared files come first."""
    found = {}
    shared = table.texts("variants_from", default=[])
    for name in shared:
        try:
            file = table.beside(name)
            other = TableReader(read_toml(file, "variants"), file, table.problems)
        except StudyError as error:
            table.problems += [f"{table.place('variants_from')}: {problem}" for problem in error.problems]
            continue
        _join(found, other.named_tables("variant"))
        other.finish()
    _join(found, table.named_tables("variant", required=not shared))
    return found


def _join(found, tables):
    for name, one in tables.items():
        if name in found:
            one.problems.append(f"{one.place()}: is also in {found[name].file}; give one of them another name")
        found.setdefault(name, one)
