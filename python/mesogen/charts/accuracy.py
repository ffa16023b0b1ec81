"""Runs an accuracy study, and writes its tables and charts."""

import os
import shutil

from ..errors import StudyError
from ..runs.check import check_cases
from ..runs.execution import command_line, execute, results_of
from ..runs.ledger import locked, stopped_too_early, write_file
from ..runs.program import Program, of_same_defaults, stamp
from ..runs.progress import Progress, wall_text
from . import measures
from .drawing import error_cost, error_resolution, look
from .expectation import expected_left
from .parts import ledger_of
from .points import points_of
from .tables import markdown, percent, points_csv

COLUMNS = ("key", "variant", "resolution", "seed", "repeat", "status", "reason", "error", "wall_seconds", "cpu_seconds",
           "steps", "peak_memory", "date", "machine", "version")


def row_of(job, study, rows):
    """The row of a job, None if the job must run: also where its run was stopped for its time, and has more now."""
    return next((row for row in rows if row["key"] == job.key and int(row["repeat"]) == job.repeat
                 and not (row["status"] == "timeout" and stopped_too_early(row, study.timeout))), None)


def missing(study, rows):
    """The jobs that must run. A point that failed once would fail again, and is not repeated."""
    failed = {row["key"] for row in rows if row["status"] == "failed"}
    return [job for job in study.jobs() if job.key not in failed and row_of(job, study, rows) is None]


def current_rows(study, rows):
    """The rows of the jobs of the study, in the order of its variants and resolutions."""
    order = {key: number for number, key in enumerate(
        study.job(variant, resolution, seed).key
        for variant in study.variants for resolution in variant.resolutions for seed in study.seeds or (None,))}
    mine = [row for row in rows if row["key"] in order and int(row["repeat"]) <= study.repeats]
    return sorted(mine, key=lambda row: order[row["key"]])


def stale(study, rows, usable):
    """Names of the points that ran, but for another study, case, answer or defaults of mesogen.

    rows: all; usable: those with the defaults of this mesogen.
    """
    there = {row["key"] for row in usable}
    before = {(row["variant"], int(row["resolution"])) for row in rows}
    return list(dict.fromkeys(job.name for job in study.jobs()
                              if job.key not in there and (job.variant, job.resolution) in before))


def list_runs(study, folder, program, write):
    """Calls write with a line for each run: its status and its command."""
    rows = of_same_defaults(ledger_of(folder, COLUMNS).rows, program)
    waiting = {(job.key, job.repeat) for job in missing(study, rows)}
    for job in study.jobs():
        row = row_of(job, study, rows)
        state = "missing" if (job.key, job.repeat) in waiting else row["status"] if row else "skipped"
        write(f"{state:8} {job.name} ({job.repeat} of {study.repeats}): "
              + command_line(program, study.scene.case, job.overrides, os.path.join(folder, "run"), study.threads))


def run_study(study, folder, program, progress_of=Progress, tell=print):
    """Does the missing runs. Raises StudyError if mesogen refuses a variant, before the first run starts."""
    with locked(folder):
        ledger = ledger_of(folder, COLUMNS)
        before = of_same_defaults(ledger.rows, program)
        for name in stale(study, ledger.rows, before):
            tell(f"{name} runs again: the study, its case, its answer or a default of mesogen has changed")
        ledger.rows = before
        waiting = missing(study, ledger.rows)
        if waiting:
            check_variants(study, program)
        progress = progress_of(len(study.jobs()), len(study.jobs()) - len(waiting))
        version = Program(program).version_for()
        try:
            while waiting:
                job = waiting[0]
                progress.start(f"{job.name} ({job.repeat} of {study.repeats})", time_left(waiting, study, ledger.rows))
                row = run_job(study, job, folder, program, progress.tick)
                ledger.add({**row, **stamp(version)})
                progress.end(row_text(row))
                left = missing(study, ledger.rows)
                progress.done += len(waiting) - 1 - len(left)
                waiting = left
        finally:
            progress.close()
            shutil.rmtree(os.path.join(folder, "run"), ignore_errors=True)


def check_variants(study, program):
    """Asks mesogen about every variant at its coarsest resolution. Raises StudyError with mesogen's own words."""
    check_cases(study.file, program, study.scene.case, {
        f"variant.{variant.name}": study.job(variant, variant.resolutions[0]).overrides for variant in study.variants},
        study.scene.answer.unfit)


def time_left(waiting, study, rows):
    """Expected s until all jobs are done, None if it is unknown."""
    known = {}
    for row in current_rows(study, rows):
        known.setdefault((row["variant"], int(row["resolution"])), []).append(float(row["wall_seconds"]))
    return expected_left([(job.variant, job.resolution) for job in waiting], known)


def run_job(study, job, folder, program, tick):
    """Does one run, and returns its row of runs.csv. Its output is measured, then removed."""
    results = os.path.join(folder, "run")
    outcome = execute(program, study.scene.case, job.overrides, results, study.threads, study.timeout, tick)
    row = {"key": job.key, "variant": job.variant, "resolution": job.resolution, "seed": job.seed, "repeat": job.repeat,
           "status": outcome.status, "reason": outcome.reason, "wall_seconds": outcome.wall, "cpu_seconds": outcome.cpu}
    if outcome.status == "done":
        with results_of(results, study.scene.answer.file) as run:
            row["error"] = measures.error(run, study.scene.answer.quantities)
            cost = run.cost
        row |= {"wall_seconds": cost.wall_seconds, "steps": cost.steps, "peak_memory": cost.peak_memory}
        if not row["error"] < float("inf"):
            row |= {"status": "failed", "reason": "what it recorded is not a number"}
    shutil.rmtree(results, ignore_errors=True)
    return row


def row_text(row):
    """How a run ended, for the terminal."""
    if row["status"] != "done":
        return f"FAILED: {row['reason']}"
    return f"error {percent(row['error'])}, {wall_text(row['wall_seconds'])}"


def write_outputs(study, folder, program):
    """Writes tables and charts of the finished runs. Returns (text of the table, names of the files)."""
    rows = current_rows(study, of_same_defaults(ledger_of(folder, COLUMNS).rows, program))
    points = points_of(rows)
    if not points:
        raise StudyError(f"{folder}: nothing has run yet; leave out --draw-only")
    text = markdown(study, points, rows)
    names = [os.path.join(folder, name) for name in ("points.csv", "table.md")]
    write_file(names[0], points_csv(points))
    write_file(names[1], text)
    if any(not p.failed and p.error > 0 for p in points):
        subtitle = study.scene.answer.title
        with look.settings():
            for module, name in ((error_cost, "error_cost"), (error_resolution, "error_resolution")):
                names += look.save(module.draw(study.title, subtitle, points), os.path.join(folder, name))
    return text, names
