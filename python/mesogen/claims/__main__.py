"""The command: mesogen study FOLDER [-o DIR] [--quick | --full] [--only SECTION]... [--retry | --write-only]"""

import argparse
import os
import sys

from ..output_folder import foreign
from ..study.command import carry_out
from ..study.errors import StudyError
from ..study.progress import Progress
from . import report
from .study_file import read_study
from .verdict import VERDICTS


def study_command(options):
    mode = "quick" if options.quick else "full" if options.full else "standard"
    study = read_study(options.study, mode, options.only)
    name = os.path.basename(os.path.abspath(options.study))
    folder = options.output or os.path.join("output", "studies", name if mode == "standard" else f"{name}_{mode}")
    # Its sweeps are folders in it, each of which says whose it is, beside that of the report.
    if problem := foreign(folder, lambda names: report.FOLDER in names or any(
            os.path.exists(os.path.join(folder, one, mark)) for one in names for mark in ("owner", ".lock"))):
        raise StudyError(problem)
    results = report.gather(study, folder, options.mesogen, options.parallel, not options.write_only,
                            lambda total, done: Progress(total, done, options.quiet),
                            lambda line: None if options.quiet else print(line, file=sys.stderr, flush=True), options.retry)
    # Some sections are a page of their own: the whole report stays.
    page = "-".join(options.only or ["index"]) + ".html"
    sections, problems = report.write(study, results, folder, options.mesogen, page)
    for section in sections:
        for claim in section.claims:
            print(f"{claim.verdict:>{max(map(len, VERDICTS))}}  {section.title}: {claim.text} {claim.numbers}")
    for problem in problems:
        print(f"warning: {problem}", file=sys.stderr)
    print(f"wrote {os.path.join(folder, report.FOLDER, page)}")
    return 1 if problems else 0


def main(arguments=None):
    """The command. Returns its exit code: 0; 1 if a run or a section is missing, or a file cannot be written; 2 if the study is wrong; 130 if it was
    interrupted."""
    parser = argparse.ArgumentParser(prog="mesogen study", description="Runs a study and reports which claims hold.")
    parser.add_argument("study", metavar="FOLDER", help="folder of a study")
    parser.add_argument("-o", "--output", metavar="DIR", help="folder for runs and report")
    parser.add_argument("--only", metavar="SECTION", type=lambda names: names.split(","), action="extend", default=[],
                        help="these sections alone, as a page of their own")
    parser.add_argument("--parallel", metavar="N", type=_count, help="runs at a time")
    modes = parser.add_mutually_exclusive_group()
    modes.add_argument("--quick", action="store_true", help="small boxes and short spans")
    modes.add_argument("--full", action="store_true", help="at the resolution of the paper")
    parser.add_argument("--write-only", action="store_true", help="run nothing: the report of what is there")
    parser.add_argument("--retry", action="store_true", help="try runs that failed again")
    parser.add_argument("--quiet", action="store_true", help="no progress")
    parser.add_argument("--mesogen", metavar="FILE", default="mesogen", help="the command that runs a case")
    options = parser.parse_args(arguments)
    return carry_out(lambda: study_command(options))


def _count(text):
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"must be a whole number of at least 1, not '{text}'")
    return int(text)


if __name__ == "__main__":
    sys.exit(main())
