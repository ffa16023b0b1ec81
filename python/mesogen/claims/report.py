"""Runs what a study needs, and writes its report."""

import datetime
import math
import os

from ..errors import MesogenError
from ..figures import style
from ..study.errors import StudyError
from ..study.ledger import write_file
from ..study.machine import machine_text, version_text
from ..study.progress import duration_text
from ..sweep import finished, read_sweep, run_sweep
from ..sweep.records import Records
from ..sweep.runner import check
from .page import page
from .results import Results, whole_cost
from .section import Section
from .study_file import where

FOLDER = "report"
NOT_RUN = "was not run"


def gather(study, folder, program, parallel, run, progress, tell, retry=False):
    """{name: Results} of all sweeps that the study's sections need. run: whether what is missing is run. progress, tell,
    retry: as run_sweep takes them.

    Raises StudyError if a sweep or its case is wrong, Interrupted if the user stops it.
    """
    # All are read before the first is run: a mistake in the last shows at once.
    read = {name: _read(study, name) for name in study.sweeps}
    if run:
        for sweep in read.values():
            check(sweep, sweep.runs, program)
    results = {}
    for name, sweep in read.items():
        target = os.path.join(folder, name)
        if run:
            tell(f"{sweep.title}: {len(sweep.runs)} runs")
            run_sweep(sweep, target, program, parallel, progress, tell, retry)
        records = Records(sweep, target)
        rows = {one.label: records.row(one) for one in sweep.runs}
        results[name] = Results(name, finished(sweep, target),
                                [(label, row["reason"] if row else NOT_RUN) for label, row in rows.items()
                                 if row is None or row["status"] != "done"])
    return results


def _read(study, name):
    changes = dict(study.changes.get(name, {}))
    seeds = changes.pop("seeds", None)
    sweep = read_sweep(study.sweep_file(name), extra=changes, seeds=seeds)
    idle = [key for key in changes if any(key in point.values for point in sweep.points)]
    if idle:
        raise StudyError([f"{os.path.join(study.folder, 'study.toml')}: {study.mode}.{name}.{key}: is without effect, "
                          f"{sweep.file} has its own values of it for each point" for key in idle])
    return sweep


def write(study, results, folder, program, name="index.html"):
    """Writes FOLDER/report, the page by this name. Returns (sections, problems): what was drawn, and in words what could not be."""
    target = os.path.join(folder, FOLDER)
    os.makedirs(target, exist_ok=True)
    sections, problems = [], []
    for sweep, found in results.items():
        problems += [f"{sweep}: {label}: {reason}" for label, reason in found.missing]
    if any(reason != NOT_RUN for found in results.values() for _, reason in found.missing):
        problems.append("what failed is tried again with --retry")
    for file in study.sections:
        section = Section(file.name, file.title, file.figure, target, {name: results[name] for name in file.sweeps},
                          study.mode)
        try:
            with style.settings():
                file.write(section)
        except MesogenError as error:  # no run, or one that lacks a quantity
            problems.append(f"section {file.name} is left out: {error}")
            continue
        except Exception as error:  # a mistake in one section must not cost the others
            problems.append(f"section {file.name} is left out: {where(study, error)}{type(error).__name__}: {error}")
            continue
        sections.append(section)
    write_file(os.path.join(target, name), page(study, sections, _provenance(study, results, program), problems))
    return sections, problems


def _provenance(study, results, program):
    facts = [("Program", version_text(program)), ("Machine", machine_text()),
             ("Mode", study.mode), ("Written", datetime.date.today().isoformat())]
    rows, seconds = [], 0.0
    for name, found in results.items():
        for one in found.runs:
            steps, spent = whole_cost(one)
            seconds += 0.0 if math.isnan(spent) else spent
            with one.open() as run:
                rows.append(f"{name}/{one.label}: seed {one.seed}, {run.count} particles, {steps} steps, "
                            f"{spent:.0f} s of processor time, {run.version}")
    facts.append(("Runs", f"{len(rows)}, {duration_text(seconds)} of processor time"))
    facts.append(("Every run", "\n".join(rows) + "\n"))
    for name in results:
        with open(study.sweep_file(name), encoding="utf-8") as file:
            facts.append((f"Sweep {name}", file.read()))
    first = next((found.runs[0] for found in results.values() if found.runs), None)
    if first:
        with first.open() as run:
            facts.append((f"The case of {first.label}, with all defaults", run.case))
    return facts
