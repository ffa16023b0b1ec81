"""The command: mesogen chart STUDY.toml [-o DIR] [--list] [--only VARIANT]... [--draw-only]"""

import argparse
import os
import sys

from ..output_folder import foreign
from . import accuracy, stability
from .accuracy_study import read_accuracy_study
from .command import carry_out
from .errors import StudyError
from .parts import only
from .progress import Progress
from .stability_study import read_stability_study
from .table_reader import nearest, read_toml

KINDS = {"accuracy": (read_accuracy_study, accuracy), "stability": (read_stability_study, stability)}


def read_study(file):
    """(the study, the module that runs it). Raises StudyError."""
    data = read_toml(file, "study")
    kind = data.get("kind")
    if kind not in KINDS:
        given = f"'{kind}' is none" if isinstance(kind, str) else "is missing; it is one"
        raise StudyError(f"{file}: kind: {given} of: {', '.join(KINDS)}"
                         + (nearest(kind, KINDS) if isinstance(kind, str) else ""))
    read, module = KINDS[kind]
    return read(file, data), module


def chart(options):
    study, module = read_study(options.study)
    study = only(study, options.only)
    name = os.path.splitext(os.path.basename(options.study))[0]
    folder = options.output or os.path.join("output", "charts", name)
    if problem := foreign(folder, lambda names: "runs.csv" in names or ".lock" in names):
        raise StudyError(problem)
    if options.list:
        module.list_runs(study, folder, options.mesogen, print)
        return
    if not options.draw_only:
        def progress(total, done):
            return Progress(total, done, options.quiet)
        module.run_study(study, folder, options.mesogen, progress, lambda line: print(line, file=sys.stderr, flush=True))
    text, names = module.write_outputs(study, folder, options.mesogen)
    print(text)
    for name in names:
        print(f"wrote {name}")


def main(arguments=None):
    """The command. Returns its exit code: 0; 1 if a file cannot be written; 2 if the study is wrong; 130 if it was
    interrupted."""
    parser = argparse.ArgumentParser(prog="mesogen chart", description="Runs a study and charts it.")
    parser.add_argument("study", metavar="STUDY", help="study file (TOML)")
    parser.add_argument("-o", "--output", metavar="DIR", help="folder for what comes out")
    parser.add_argument("--only", metavar="VARIANT", type=lambda names: names.split(","), action="extend", default=[],
                        help="these variants alone")
    parser.add_argument("--list", action="store_true", help="list the runs; runs nothing")
    parser.add_argument("--draw-only", action="store_true", help="run nothing: tables and charts of what is there")
    parser.add_argument("--quiet", action="store_true", help="no progress")
    parser.add_argument("--mesogen", metavar="FILE", default="mesogen", help="the command that runs a case")
    options = parser.parse_args(arguments)
    return carry_out(lambda: chart(options))


if __name__ == "__main__":
    sys.exit(main())
