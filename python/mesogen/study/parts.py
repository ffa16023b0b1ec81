"""What studies of all kinds have: a scene and variants of it.

Variants stand in the study itself, as tables [variant.NAME], and in files that studies share:

    variants_from = ["variants/flow.toml"]      # relative to the study; each holds tables [variant.NAME] alone
"""

import dataclasses
import os

from .errors import StudyError
from .scene import read_scene
from .table_reader import TableReader, nearest, read_toml


def beside(file, name):
    """A path that a study gives, relative to the study's file."""
    return os.path.normpath(os.path.join(os.path.dirname(file), name))


def only(study, names):
    """The study with these variants alone, all if there are none. Raises StudyError for a name that is none."""
    known = [variant.name for variant in study.variants]
    for name in names:
        if name not in known:
            raise StudyError(f"--only: no variant '{name}' in {study.file}{nearest(name, known)}")
    return dataclasses.replace(study, variants=tuple(v for v in study.variants if not names or v.name in names))


def scene_of(table, answer_required=True):
    """The scene that the study's table names, None if there is a problem with it."""
    place = table.text("scene")
    if place is None:
        return None
    try:
        return read_scene(beside(table.file, place), table.problems, answer_required)
    except StudyError as error:
        table.problems += [f"{table.place('scene')}: {problem}" for problem in error.problems]
        return None


def variant_tables(table):
    """{name: TableReader} of the study's variants: those of shared files first, in their order."""
    found = {}
    shared = table.texts("variants_from", default=[])
    for name in shared:
        try:
            other = TableReader(read_toml(beside(table.file, name), "variants"), beside(table.file, name), table.problems)
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
