"""The folder of a study, read and checked: study.toml, sweeps, sections."""

import importlib.util
import os
import traceback
from dataclasses import dataclass

from ..errors import StudyError
from ..runs.overrides import read_overrides
from ..runs.table_reader import TableReader, nearest, read_toml


@dataclass(frozen=True)
class SectionFile:
    """The Python file of a section: its TITLE, FIGURE, SWEEPS and write(section)."""

    name: str
    title: str
    figure: str
    sweeps: tuple
    write: object


@dataclass(frozen=True)
class Study:
    """A study. changes: {sweep: {key: value}} of the mode; the key `seeds` replaces the seeds of a sweep."""

    title: str
    source: str
    folder: str
    mode: str
    sections: tuple
    changes: dict

    @property
    def sweeps(self):
        """Names of the sweeps that the sections need, in the order of their first use."""
        return tuple(dict.fromkeys(name for section in self.sections for name in section.sweeps))

    def sweep_file(self, name):
        """The path of a sweep."""
        return os.path.join(self.folder, name + ".toml")


def read_study(folder, mode="standard", only=()):
    """The Study of a folder. only: names of sections, all if empty. Raises StudyError with all problems."""
    file = os.path.join(folder, "study.toml")
    if not os.path.isfile(file):
        raise StudyError(f"{folder}: holds no study.toml; give the folder of a study, such as studies/paper")
    problems = []
    table = TableReader(read_toml(file, "study"), file, problems)
    title = table.text("title", os.path.basename(os.path.abspath(folder)))
    source = table.text("source", "")
    names = table.texts("sections")
    if names == []:
        table.refuse("sections", "must name one section or more")
    names = names or []
    problems += [f"{file}: has no section '{name}'{nearest(name, names)}" for name in only if name not in names]
    changes = {"standard": {}, **{one: _changes(table, one, folder) for one in ("quick", "full")}}
    table.finish()
    if problems:
        raise StudyError(problems)
    sections = tuple(_read_section(folder, name) for name in names if not only or name in only)
    study = Study(title, source, folder, mode, sections, changes[mode])
    for name in study.sweeps:
        if not os.path.isfile(study.sweep_file(name)):
            raise StudyError(f"{study.sweep_file(name)}: no such sweep; a section of {file} needs it")
    return study


def _read_section(folder, name):
    file = os.path.join(folder, name + ".py")
    if not os.path.isfile(file):
        raise StudyError(f"{file}: no such file; study.toml has a section '{name}'")
    spec = importlib.util.spec_from_file_location(f"mesogen_section_{name}", file)
    module = importlib.util.module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except SyntaxError as error:
        raise StudyError(f"{error.filename}:{error.lineno}: {error.msg}") from error
    except Exception as error:
        raise StudyError(f"{file}{_line(error, file)}: {type(error).__name__}: {error}") from error
    lacking = [what for what in ("TITLE", "SWEEPS", "write") if not hasattr(module, what)]
    if lacking:
        raise StudyError(f"{file}: a section must have {', '.join(lacking)}")
    if isinstance(module.SWEEPS, str):
        raise StudyError(f'{file}: SWEEPS must be a list of names, ["{module.SWEEPS}"]')
    return SectionFile(name, module.TITLE, getattr(module, "FIGURE", ""), tuple(module.SWEEPS), module.write)


def where(study, error):
    """The place in a section at which an error arose, "FILE:LINE: "; "" if it arose elsewhere."""
    for section in study.sections:
        file = os.path.join(study.folder, section.name + ".py")
        line = _line(error, file)
        if line:
            return f"{file}{line}: "
    return ""


def _line(error, file):
    lines = [frame.lineno for frame in traceback.extract_tb(error.__traceback__)
             if os.path.abspath(frame.filename) == os.path.abspath(file)]
    return f":{lines[-1]}" if lines else ""


def _changes(table, mode, folder):
    """{sweep: {key: value}} of the tables [quick.SWEEP] or [full.SWEEP]."""
    sweeps = sorted(name[:-5] for name in os.listdir(folder) if name.endswith(".toml") and name != "study.toml")
    changes = {}
    for sweep, one in table.named_tables(mode, required=False).items():
        if sweep not in sweeps:
            one.problems.append(f"{one.place()}: no such sweep{nearest(sweep, sweeps)}")
        seeds = one.integers("seeds", None, at_least=0)
        changes[sweep] = {**read_overrides(one, ("seeds",)), **({} if seeds is None else {"seeds": seeds})}
    return changes
