"""The command: mesogen sweep SWEEP.toml [-o DIR] [--list] [--collect-only] [--slurm] ..."""

import os
import sys
from functools import partial

from ..errors import StudyError
from ..output_folder import foreign
from ..runs.command import carry_out, parser, show, tell
from ..runs.execution import command_line
from ..runs.program import Program
from ..runs.progress import Progress
from ..runs.records import Records
from ..runs.runner import run_sweep
from ..runs.sweep_file import read_sweep
from . import slurm
from .tables import write_tables


def sweep(options):
    """Does what the options ask for. Returns the exit code."""
    one = read_sweep(options.sweep, threads=options.threads)
    folder = options.output or os.path.join("output", "sweeps", one.name)
    if problem := foreign(folder, lambda names: "owner" in names or ".lock" in names):
        raise StudyError(problem)
    if options.list:
        list_runs(one, folder, options.mesogen, print)
        return 0
    if options.task is not None:
        row = slurm.do_task(one, options.task, folder, options.mesogen, options.retry)
        if row is None or row["status"] == "done":
            return 0
        tell(f"error: {row['label']}: {row['reason']}")
        return 1
    if options.slurm:
        slurm.submit(one, folder, options.mesogen, options.slurm_options, options.parallel, options.dry_run,
                     options.retry, print)
        return 0
    if not options.collect_only:
        run_sweep(one, folder, options.mesogen, options.parallel, partial(Progress, quiet=options.quiet), tell,
                  options.retry)
    show(*write_tables(one, folder, options.mesogen))
    return 0


def list_runs(one, folder, program, write):
    """Calls write with a line for each run of the sweep: its status and its command."""
    records = Records(one, folder, Program(program))
    for run in one.runs:
        command = command_line(program, one.case, run.overrides, records.results(run), one.threads,
                               one.ranks)
        write(f"{records.status(run):8} {run.label}: {command}")


def main(arguments=None):
    """The command. Returns its exit code: that of carry_out, and 1 if the run of a task failed."""
    options = parser("sweep", "Runs a case over parameters and seeds.")
    options.add_argument("sweep", metavar="SWEEP", help="sweep file (TOML)")
    options.add_argument("--list", action="store_true", help="list the runs; runs nothing")
    options.add_argument("--parallel", metavar="N", type=int, help="runs at a time")
    options.add_argument("--threads", metavar="N", type=int, help="threads of a run")
    options.add_argument("--retry", action="store_true", help="try runs that failed again")
    options.add_argument("--collect-only", action="store_true", help="run nothing: tables of what is there")
    options.add_argument("--slurm", action="store_true", help="submit the runs as a job array")
    options.add_argument("--slurm-options", metavar="TEXT", default="", help="options of sbatch")
    options.add_argument("--dry-run", action="store_true", help="with --slurm: write the job script, submit nothing")
    options.add_argument("--task", metavar="N", type=int, help="do one run of the job array")
    given = options.parse_args(arguments)
    return carry_out(lambda: sweep(given))


if __name__ == "__main__":
    sys.exit(main())
