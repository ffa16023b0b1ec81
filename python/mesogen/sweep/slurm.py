"""A sweep as a job array of Slurm, one task per run.

    slurm/job.sh      the script that sbatch takes
    slurm/tasks.csv   number of each task, label and key of its run
    slurm/job         number of the last submitted job

A task writes only to the folders of its run (see runs/records.py): machines that share a folder by NFS must not append
to the same file.
"""

import csv
import os
import re
import shlex
import shutil
import subprocess
import time

from ..errors import StudyError
from ..runs.attempt import Attempt
from ..runs.execution import PAUSE
from ..runs.ledger import csv_text, locked, write_file
from ..runs.program import Program
from ..runs.records import Records
from ..runs.runner import busy_text, prepare

COLUMNS = ("task", "label", "key")
GRACE = 60  # s before the end of its time at which a task gets SIGTERM: enough for a step and a checkpoint


def submit(sweep, folder, program, options="", at_a_time=None, dry=False, retry=False, tell=print):
    """Submits the missing runs as one job array.

    options: of sbatch, as on a command line. at_a_time: tasks at a time, None: Slurm decides. dry: writes script and
    list of tasks, submits nothing. tell: takes messages for the user. Raises StudyError if there is no sbatch, if
    sbatch refuses the script, and while the last job of this sweep is in the queue.
    """
    with locked(folder, busy_text(folder)):
        records = Records(sweep, folder, Program(program))
        records.claim()
        records.gather()
        _refuse_twice(folder)
        waiting = prepare(records, tell, retry)
        if not waiting:
            tell("nothing to submit: no run is missing; --collect-only writes the tables, --retry submits what failed")
            return
        files = [os.path.join(folder, "slurm", name) for name in ("tasks.csv", "job.sh")]
        os.makedirs(os.path.join(folder, "slurm"), exist_ok=True)
        write_file(files[0], csv_text(COLUMNS, [(n, run.label, run.key) for n, run in enumerate(waiting, start=1)]))
        write_file(files[1], script(sweep, folder, program, len(waiting), options, at_a_time, retry))
        if dry:
            tell(f"wrote {files[0]} and {files[1]}: {_runs(len(waiting))}; nothing was submitted")
            return
        number = _sbatch(files[1])
        write_file(os.path.join(folder, "slurm", "job"), number + "\n")
        tell(f"submitted job {number}: {_runs(len(waiting))}; --collect-only writes the tables of those that are done")


def script(sweep, folder, program, tasks, options="", at_a_time=None, retry=False):
    """The text of the job script."""
    here = os.path.abspath
    words = [here(shutil.which(program) or program), "sweep", here(sweep.file), "--output", here(folder), "--threads",
             str(sweep.threads), "--quiet", *(["--retry"] if retry else [])]
    log = os.path.join(here(folder), "slurm", "%A_%a.log")
    lines = [
        f"--job-name={re.sub(r'[^A-Za-z0-9_.-]', '_', sweep.name)}",
        f"--array=1-{tasks}" + (f"%{at_a_time}" if at_a_time else ""),
        f"--ntasks={sweep.ranks}", f"--cpus-per-task={sweep.threads}",
        f'--output="{log}"' if " " in log else f"--output={log}",
        f"--signal=B:TERM@{GRACE}",
        *_option_lines(options),
    ]
    return "\n".join(["#!/bin/sh", *(f"#SBATCH {line}" for line in lines),
                      "# Told that its time is over, a task leaves a checkpoint; exec: so that it is told.",
                      f'exec {shlex.join(words)} --task "$SLURM_ARRAY_TASK_ID"', ""])


def do_task(sweep, number, folder, program, retry=False):
    """Does the run of a task, and returns its row of runs.csv; None if the run was done before.

    Raises StudyError if there is no such task, or the sweep has changed since it was submitted.
    """
    file = os.path.join(folder, "slurm", "tasks.csv")
    try:
        with open(file, encoding="utf-8", newline="") as stream:
            tasks = {row["task"]: row for row in csv.DictReader(stream)}
    except FileNotFoundError:
        raise StudyError(f"--task: {file} is not there; --slurm writes it") from None
    task = tasks.get(str(number))
    if task is None:
        raise StudyError(f"--task: {file} has no task {number}; there are 1 to {len(tasks)}")
    run = next((run for run in sweep.runs if run.label == task["label"] and run.key == task["key"]), None)
    if run is None:
        raise StudyError(f"--task: {task['label']} is no more the run that was submitted: {sweep.file} or its case has "
                         "changed; submit it again with --slurm")
    records = Records(sweep, folder, Program(program))
    if records.settled(run, retry) is not None:
        return None
    attempt = Attempt(records, run)
    try:
        while (row := attempt.poll()) is None:
            time.sleep(PAUSE)
        records.add_task_row(run, row)
        return row
    finally:
        attempt.stop()


def _option_lines(options):
    """A list of options, each with its value: "--time=1:00 -p long" gives two."""
    lines = []
    for word in shlex.split(options):
        if word.startswith("-") or not lines:
            lines.append(word)
        else:
            lines[-1] += " " + shlex.quote(word)
    for line in lines:
        if not line.startswith("-"):
            raise StudyError(f'--slurm-options: "{line}" is no option of sbatch; write them as in "--time=12:00:00 '
                             '--partition=long"')
    return lines


def _sbatch(file):
    if shutil.which("sbatch") is None:
        raise StudyError(f"sbatch is not found: Slurm is not installed here; --dry-run writes {file} alone, and "
                         "without --slurm the runs are done on this machine")
    done = _ask("sbatch", "--parsable", file)
    if done.returncode != 0:
        raise StudyError(f"sbatch does not take {file}: {done.stderr.strip().removeprefix('sbatch: error: ')}")
    return done.stdout.strip().split(";")[0]


def _refuse_twice(folder):
    """Raises StudyError while the last submitted job is in the queue."""
    try:
        with open(os.path.join(folder, "slurm", "job"), encoding="utf-8") as file:
            number = file.read().strip()
    except FileNotFoundError:
        return
    if shutil.which("squeue") is None:
        return
    done = _ask("squeue", "--noheader", "--jobs", number)
    if done.returncode == 0 and done.stdout.strip():
        raise StudyError(f"job {number} of this sweep is in the queue; wait for it, or end it with: scancel {number}")


def _ask(*words):
    return subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)


def _runs(count):
    return f"{count} run{'s' if count != 1 else ''}"
