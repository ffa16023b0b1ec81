"""The command: mesogen study FOLDER [-o DIR] [--quick | --full] [--only SECTION]... [--retry | --write-only]"""

import argparse
import os
import sys
from functools import partial

from ..errors import StudyError
from ..output_folder import foreign
from ..runs.command import carry_out, parser, tell
from ..runs.progress import Progress
from . import report
from .study_file import read_study
from .verdict import VERDICTS


def study_command(options):
    """Does what the options ask for. Returns the exit code."""
    mode = "quick" if options.quick else "full" if options.full else "standard"
    study = read_study(options.study, mode, options.only)
    name = os.path.basename(os.path.abspath(options.study))
    folder = options.output or os.path.join("output", "studies", name if mode == "standard" else f"{name}_{mode}")
    # It holds the folder of the report and one of each sweep, with a file `owner` or `.lock` in it.
    if problem := foreign(folder, lambda names: report.FOLDER in names or any(
            os.path.exists(os.path.join(folder, one, mark)) for one in names for mark in ("owner", ".lock"))):
        raise StudyError(problem)
    results = report.gather(study, folder, options.mesogen, options.parallel, not options.write_only,
                            partial(Progress, quiet=options.quiet),
                            (lambda _: None) if options.quiet else tell, options.retry)
    # Chosen sections go to a page of their own, beside the whole report.
    page = "-".join(options.only or ["index"]) + ".html"
    sections, problems = report.write(study, results, folder, options.mesogen, page)
    for section in sections:
        for claim in section.claims:
            print(f"{claim.verdict:>{max(map(len, VERDICTS))}}  {section.title}: {claim.text} {claim.numbers}")
    for problem in problems:
        tell(f"warning: {problem}")
    print(f"wrote {os.path.join(folder, report.FOLDER, page)}")
    return 1 if problems else 0


def main(arguments=None):
    """The command. Returns its exit code: that of carry_out, and 1 if a run or a section is missing."""
    options = parser("study", "Runs a study and reports which claims hold.")
    options.add_argument("study", metavar="FOLDER", help="folder of a study")
    options.add_argument("--only", metavar="SECTION", type=lambda names: names.split(","), action="extend",
                         default=[], help="these sections alone, as a page of their own")
    options.add_argument("--parallel", metavar="N", type=_count, help="runs at a time")
    modes = options.add_mutually_exclusive_group()
    modes.add_argument("--quick", action="store_true", help="small boxes and short spans")
    modes.add_argument("--full", action="store_true", help="at the resolution of the paper")
    options.add_argument("--write-only", action="store_true", help="run nothing: the report of what is there")
    options.add_argument("--retry", action="store_true", help="try runs that failed again")
    given = options.parse_args(arguments)
    return carry_out(lambda: study_command(given))


def _count(text):
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"must be a whole number of at least 1, not '{text}'")
    return int(text)


if __name__ == "__main__":
    sys.exit(main())
