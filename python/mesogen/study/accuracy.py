"""Runs an accuracy study and writes what it shows."""

import datetime
import os
import shutil

import mesogen

from ..errors import MesogenError
from . import measures
from .drawing import error_cost, error_resolution, look
from .errors import StudyError
from .execution import command_line, execute, refusals
from .expectation import expected_left
from .ledger import Ledger, locked, write_file
from .machine import machine_text, of_same_defaults, program_text
from .points import points_of
from .progress import Progress, duration_text
from .recorded import unfit_answer
from .tables import markdown, percent, points_csv

COLUMNS = ("key", "variant", "resolution", "seed", "repeat", "status", "reason", "error", "wall_seconds", "cpu_seconds",
           "steps", "peak_memory", "date", "machine", "version")


def row_of(job, study, rows):
    """The row of a job, None if it has yet to run. A run that was stopped for its time counts only while the study
    gives no more of it."""
    for row in rows:
        if row["key"] == job.key and int(row["repeat"]) == job.repeat:
            too_early = row["status"] == "timeout" and not (study.timeout and float(row["wall_seconds"]) >= study.timeout)
            if not too_early:
                return row
    return None


def missing(study, rows):
    """The jobs that have yet to run. A point that failed once fails again, and is not repeated."""
    failed = {row["key"] for row in rows if row["status"] == "failed"}
    return [job for job in study.jobs() if job.key not in failed and row_of(job, study, rows) is None]


def current_rows(study, rows):
    """The rows that belong to the study as it is now, in the order of its variants and resolutions."""
    keys = {job.key: job for job in study.jobs()}
    order = {key: number for number, key in enumerate(
        study.job(variant, resolution, seed).key
        for variant in study.variants for resolution in variant.resolutions for seed in study.seeds or (None,))}
    mine = [row for row in rows if row["key"] in keys and int(row["repeat"]) <= study.repeats]
    return sorted(mine, key=lambda row: order[row["key"]])


def stale(study, rows, usable):
    """Names of points that ran for another form of the study, its case, its answer or mesogen, and not for this one.
    rows: all; usable: those of this mesogen."""
    there = {row["key"] for row in usable}
    before = {(row["variant"], int(row["resolution"])) for row in rows}
    return list(dict.fromkeys(job.name for job in study.jobs()
                              if job.key not in there and (job.variant, job.resolution) in before))


def list_runs(study, folder, program, write):
    """Every run, whether it is done, and its command."""
    rows = of_same_defaults(Ledger(os.path.join(folder, "runs.csv"), COLUMNS).rows, program)
    waiting = {(job.key, job.repeat) for job in missing(study, rows)}
    for job in study.jobs():
        row = row_of(job, study, rows)
        state = "missing" if (job.key, job.repeat) in waiting else row["status"] if row else "skipped"
        write(f"{state:8} {job.name} ({job.repeat} of {study.repeats}): "
              + command_line(program, study.scene.case, job.overrides, os.path.join(folder, "run"), study.threads))


def run_study(study, folder, program, progress_of=Progress, tell=print):
    """Does what is missing. Raises StudyError if mesogen refuses a variant, before anything is run."""
    with locked(folder):
        ledger = Ledger(os.path.join(folder, "runs.csv"), COLUMNS)
        before = of_same_defaults(ledger.rows, program)
        for name in stale(study, ledger.rows, before):
            tell(f"{name} runs again: the study, its case, its answer or a default of mesogen has changed")
        ledger.rows = before
        waiting = missing(study, ledger.rows)
        if waiting:
            check_variants(study, program)
        progress = progress_of(len(study.jobs()), len(study.jobs()) - len(waiting))
        where = {"machine": machine_text(), "version": program_text(program)}
        try:
            while waiting:
                job = waiting[0]
                progress.start(f"{job.name} ({job.repeat} of {study.repeats})", time_left(waiting, study, ledger.rows))
                row = run_job(study, job, folder, program, progress.tick)
                ledger.add({**row, **where})
                progress.end(row_text(row))
                left = missing(study, ledger.rows)
                progress.done += len(waiting) - 1 - len(left)
                waiting = left
        finally:
            progress.close()
            shutil.rmtree(os.path.join(folder, "run"), ignore_errors=True)


def check_variants(study, program):
    """Lets mesogen look at every variant, at its coarsest. Raises StudyError with mesogen's own words."""
    said = refusals(program, study.scene.case, {
        f"variant.{variant.name}": study.job(variant, variant.resolutions[0]).overrides for variant in study.variants},
        lambda recorded: unfit_answer(recorded, study.scene.answer))
    if said:
        raise StudyError([f"{study.file}: {', '.join(names)}: {line}" for line, names in said.items()])


def time_left(waiting, study, rows):
    """Expected s until all jobs are done, None if nobody knows."""
    known = {}
    for row in current_rows(study, rows):
        known.setdefault((row["variant"], int(row["resolution"])), []).append(float(row["wall_seconds"]))
    return expected_left([(job.variant, job.resolution) for job in waiting], known)


def run_job(study, job, folder, program, tick):
    """One run, as a row of the ledger. What it wrote is measured and removed."""
    results = os.path.join(folder, "run")
    outcome = execute(program, study.scene.case, job.overrides, results, study.threads, study.timeout, tick)
    row = {"key": job.key, "variant": job.variant, "resolution": job.resolution, "seed": job.seed, "repeat": job.repeat,
           "status": outcome.status, "reason": outcome.reason, "wall_seconds": outcome.wall, "cpu_seconds": outcome.cpu,
           "date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")}
    if outcome.status == "done":
        try:
            with mesogen.open(results) as run:
                row["error"] = measures.error(run, study.scene.answer.quantities)
                cost = run.cost
        except MesogenError as error:
            raise StudyError(f"{study.scene.answer.file}: {error}") from error
        row |= {"wall_seconds": cost.wall_seconds, "steps": cost.steps, "peak_memory": cost.peak_memory}
        if not row["error"] < float("inf"):
            row |= {"status": "failed", "reason": "what it recorded is not a number"}
    shutil.rmtree(results, ignore_errors=True)
    return row


def row_text(row):
    took = duration_text(row["wall_seconds"]) if row["wall_seconds"] >= 10 else f"{row['wall_seconds']:.2g} s"
    return f"error {percent(row['error'])}, {took}" if row["status"] == "done" else f"FAILED: {row['reason']}"


def write_outputs(study, folder, program):
    """Tables and charts of what is there. Returns (the table's text, names of files written)."""
    rows = current_rows(study, of_same_defaults(Ledger(os.path.join(folder, "runs.csv"), COLUMNS).rows, program))
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
