"""A study that tests claims, as its folder tells it: study.toml, sweeps, sections."""

import importlib.util
import os
import traceback
from dataclasses import dataclass

from ..study.errors import StudyError
from ..study.overrides import is_value
from ..study.table_reader import TableReader, nearest, read_toml

MODES = ("quick", "standard", "full")
KEYS = ("title", "source", "sections", "quick", "full")


@dataclass(frozen=True)
class SectionFile:
    """The Python file of a section: TITLE, FIGURE, SWEEPS and write(section)."""

    name: str
    title: str
    figure: str
    sweeps: tuple
    write: object


@dataclass(frozen=True)
class Study:
    """What study.toml says. changes: {sweep: {key: value}} of the mode that was asked for; `seeds` among them."""

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
        return os.path.join(self.folder, name + ".toml")


def read_study(folder, mode="standard", only=()):
    """The study of a folder. only: names of sections. Raises StudyError with all that is wrong in study.toml."""
    file = os.path.join(folder, "study.toml")
    if not os.path.isfile(file):
        raise StudyError(f"{folder}: holds no study.toml; give the folder of a study, such as studies/paper")
    data = read_toml(file, "study")
    problems = [f"{file}: {key}: is no key of a study{nearest(key, KEYS)}" for key in data if key not in KEYS]
    problems += [f"{file}: {key}: must be a text" for key in ("title", "source") if not isinstance(data.get(key, ""), str)]
    names = data.get("sections")
    if not isinstance(names, list) or not names or not all(isinstance(name, str) for name in names):
        problems.append(f"{file}: sections: must be a list of names, each of a Python file in the folder")
        names = []
    for name in only:
        if name not in names:
            problems.append(f"{file}: has no section '{name}'{nearest(name, names)}")
    if problems:
        raise StudyError(problems)
    sections = tuple(_read_section(folder, name) for name in names if not only or name in only)
    problems = [problem for one in MODES for problem in _wrong_changes(data.get(one, {}), file, one, folder)]
    if problems:
        raise StudyError(problems)
    study = Study(data.get("title", os.path.basename(os.path.abspath(folder))), data.get("source", ""), folder, mode,
                  sections, data.get(mode, {}))
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
    """Where in a file of the study an error arose, "FILE:LINE: "; "" if it did not."""
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


def _wrong_changes(tables, file, mode, folder):
    """What is wrong with [quick] or [full], where [quick.SWEEP] tells what changes in a sweep."""
    at = f"{file}: {mode}"
    if not isinstance(tables, dict):
        return [f"{at}: must hold tables [{mode}.SWEEP] of keys that a sweep changes"]
    sweeps = sorted(name[:-5] for name in os.listdir(folder) if name.endswith(".toml") and name != "study.toml")
    problems = []
    for sweep, table in tables.items():
        if not isinstance(table, dict):
            problems.append(f"{at}.{sweep}: must be a table of keys that a sweep changes: [{mode}.SWEEP]")
            continue
        if sweep not in sweeps:
            problems.append(f"{at}.{sweep}: no such sweep{nearest(sweep, sweeps)}")
        reader = TableReader(table, file, problems, f"{mode}.{sweep}")
        reader.integers("seeds", None, at_least=0)
        for key, value in table.items():
            if key != "seeds" and ("." not in key or not is_value(value)):
                problems.append(f'{at}.{sweep}.{key}: is neither `seeds` nor a dotted key of a case such as '
                                '"particles.spacing" with a value')
    return problems
