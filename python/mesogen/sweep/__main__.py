"""The command: mesogen sweep SWEEP.toml [-o DIR] [--list] [--collect-only] [--slurm] ..."""

import argparse
import os
import sys

from ..output_folder import foreign
from ..study.command import carry_out
from ..study.errors import StudyError
from ..study.progress import Progress
from . import slurm
from .runner import list_runs, run_sweep
from .sweep_file import read_sweep
from .tables import write_tables


def sweep(options):
    """Does what was asked. Returns the exit code."""
    one = read_sweep(options.sweep, threads=options.threads)
    folder = options.output or os.path.join("output", "sweeps", one.name)
    if problem := foreign(folder, lambda names: "owner" in names or ".lock" in names):
        raise StudyError(problem)

    def tell(line):
        print(line, file=sys.stderr, flush=True)

    if options.list:
        list_runs(one, folder, options.mesogen, print)
        return 0
    if options.task is not None:
        row = slurm.do_task(one, options.task, folder, options.mesogen, options.retry)
        if row and row["status"] != "done":
            tell(f"error: {row['label']}: {row['reason']}")
        return 1 if row and row["status"] != "done" else 0
    if options.slurm:
        slurm.submit(one, folder, options.mesogen, options.slurm_options, options.parallel, options.dry_run,
                     options.retry, print)
        return 0
    if not options.collect_only:
        def progress(total, done):
            return Progress(total, done, options.quiet)
        run_sweep(one, folder, options.mesogen, options.parallel, progress, tell, options.retry)
    text, names = write_tables(one, folder, options.mesogen)
    print(text)
    for name in names:
        print(f"wrote {name}")
    return 0


def main(arguments=None):
    """The command. Returns its exit code: 0; 1 if a task's run failed or a file cannot be written; 2 if the sweep is
    wrong; 130 if it was interrupted."""
    parser = argparse.ArgumentParser(prog="mesogen sweep", description="Runs a case over parameters and seeds.")
    parser.add_argument("sweep", metavar="SWEEP", help="sweep file (TOML)")
    parser.add_argument("-o", "--output", metavar="DIR", help="folder for what comes out")
    parser.add_argument("--list", action="store_true", help="list the runs; runs nothing")
    parser.add_argument("--parallel", metavar="N", type=int, help="runs at a time")
    parser.add_argument("--threads", metavar="N", type=int, help="threads of a run")
    parser.add_argument("--retry", action="store_true", help="try runs that failed again")
    parser.add_argument("--collect-only", action="store_true", help="run nothing: tables of what is there")
    parser.add_argument("--slurm", action="store_true", help="submit the runs as a job array")
    parser.add_argument("--slurm-options", metavar="TEXT", default="", help="options of sbatch")
    parser.add_argument("--dry-run", action="store_true", help="with --slurm: write the job script, submit nothing")
    parser.add_argument("--task", metavar="N", type=int, help="do one run of the job array")
    parser.add_argument("--quiet", action="store_true", help="no progress")
    parser.add_argument("--mesogen", metavar="FILE", default="mesogen", help="the command that runs a case")
    options = parser.parse_args(arguments)
    return carry_out(lambda: sweep(options))


if __name__ == "__main__":
    sys.exit(main())
