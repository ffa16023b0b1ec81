"""Does the runs that a study needs, and writes its report."""

import datetime
import math
import os

from ..errors import MesogenError, StudyError
from ..figures import style
from ..runs.finished import finished
from ..runs.ledger import write_file
from ..runs.program import machine_text, version_text
from ..runs.progress import duration_text
from ..runs.records import Records
from ..runs.runner import check, run_sweep
from ..runs.sweep_file import read_sweep
from .page import page
from .results import Results, whole_cost
from .section import Section
from .study_file import where

FOLDER = "report"
NOT_RUN = "was not run"


def gather(study, folder, program, parallel, run, progress, tell, retry=False):
    """{name: Results} of all sweeps that the sections need.

    run: whether missing runs are done. parallel, progress, tell, retry: see runs/runner.py, run_sweep.
    Raises StudyError if a sweep or its case is wrong, Interrupted if the user stops it.
    """
    # All sweeps are read and checked before the first run, so that an error in the last one shows at once.
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
    """Writes the page `name` into folder/report.

    Returns (sections, problems): the Sections of the page, and texts about what is missing in it.
    """
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
        except MesogenError as error:  # a run or a quantity is missing
            problems.append(f"section {file.name} is left out: {error}")
            continue
        except Exception as error:  # an error in one section must not cost the others
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
