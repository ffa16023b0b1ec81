"""Runs what a study needs, and writes its report."""

import datetime
import os

from ..errors import MesogenError
from ..figures import style
from ..study.ledger import write_file
from ..study.machine import machine_text, version_text
from ..study.progress import duration_text
from ..sweep import finished, read_sweep, run_sweep
from ..sweep.records import Records
from .page import page
from .results import Results
from .section import Section

FOLDER = "report"


def gather(study, folder, program, parallel, run, progress, tell):
    """{name: Results} of all sweeps that the study's sections need. run: whether what is missing is run. progress, tell: as
    run_sweep takes them.

    Raises StudyError if a sweep or its case is wrong, Interrupted if the user stops it.
    """
    # All are read before the first is run: a mistake in the last shows at once.
    read = {name: _read(study, name) for name in study.sweeps}
    results = {}
    for name, sweep in read.items():
        target = os.path.join(folder, name)
        if run:
            tell(f"{sweep.title}: {len(sweep.runs)} runs")
            run_sweep(sweep, target, program, parallel, progress, tell)
        records = Records(sweep, target)
        rows = {one.label: records.row(one) for one in sweep.runs}
        results[name] = Results(name, finished(sweep, target),
                                [(label, row["reason"] if row else "was not run") for label, row in rows.items()
                                 if row is None or row["status"] != "done"])
    return results


def _read(study, name):
    changes = dict(study.changes.get(name, {}))
    seeds = changes.pop("seeds", None)
    return read_sweep(study.sweep_file(name), extra=changes, seeds=seeds)


def write(study, results, folder, program):
    """Writes FOLDER/report. Returns (sections, problems): what was drawn, and in words what could not be."""
    target = os.path.join(folder, FOLDER)
    os.makedirs(target, exist_ok=True)
    sections, problems = [], []
    for name, found in results.items():
        problems += [f"{name}: {label}: {reason}" for label, reason in found.missing]
    for file in study.sections:
        section = Section(file.name, file.title, file.figure, target, {name: results[name] for name in file.sweeps},
                          study.mode)
        try:
            with style.settings():
                file.write(section)
        except MesogenError as error:  # no run, or one that lacks a quantity
            problems.append(f"section {file.name} is left out: {error}")
            continue
        sections.append(section)
    write_file(os.path.join(target, "index.html"), page(study, sections, _provenance(study, results, program)))
    return sections, problems


def _provenance(study, results, program):
    facts = [("Program", version_text(program)), ("Machine", machine_text()),
             ("Mode", study.mode), ("Written", datetime.date.today().isoformat())]
    rows, seconds = [], 0.0
    for name, found in results.items():
        for one in found.runs:
            with one.open() as run:
                seconds += run.cost.cpu_seconds
                rows.append(f"{name}/{one.label}: seed {one.seed}, {run.count} particles, {run.cost.steps} steps, "
                            f"{run.cost.cpu_seconds:.0f} s of processor time, {run.version}")
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
