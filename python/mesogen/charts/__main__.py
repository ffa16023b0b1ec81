"""The command: mesogen chart STUDY.toml [-o DIR] [--list] [--only VARIANT]... [--draw-only]"""

import os
import sys
from functools import partial

from ..errors import StudyError
from ..output_folder import foreign
from ..runs.command import carry_out, parser, show, tell
from ..runs.progress import Progress
from ..runs.table_reader import nearest, read_toml
from . import accuracy, stability
from .accuracy_study import read_accuracy_study
from .parts import only
from .stability_study import read_stability_study

KINDS = {"accuracy": (read_accuracy_study, accuracy), "stability": (read_stability_study, stability)}


def read_study(file):
    """(study, module that runs it). Raises StudyError."""
    data = read_toml(file, "study")
    kind = data.get("kind")
    if kind not in KINDS:
        given = f"'{kind}' is none" if isinstance(kind, str) else "is missing; it is one"
        raise StudyError(f"{file}: kind: {given} of: {', '.join(KINDS)}"
                         + (nearest(kind, KINDS) if isinstance(kind, str) else ""))
    read, module = KINDS[kind]
    return read(file, data), module


def chart(options):
    """Does what the options ask for."""
    study, module = read_study(options.study)
    study = only(study, options.only)
    name = os.path.splitext(os.path.basename(options.study))[0]
    folder = options.output or os.path.join("output", "charts", name)
    if problem := foreign(folder, lambda names: "runs.csv" in names or ".lock" in names):
        raise StudyError(problem)
    if options.list:
        module.check_variants(study, options.mesogen)
        module.list_runs(study, folder, options.mesogen, print)
        return
    if not options.draw_only:
        module.run_study(study, folder, options.mesogen, partial(Progress, quiet=options.quiet), tell)
    show(*module.write_outputs(study, folder, options.mesogen))


def main(arguments=None):
    """The command. Returns its exit code; see carry_out."""
    options = parser("chart", "Runs a study and charts it.")
    options.add_argument("study", metavar="STUDY", help="study file (TOML)")
    options.add_argument("--only", metavar="VARIANT", type=lambda names: names.split(","), action="extend",
                         default=[], help="these variants alone")
    options.add_argument("--list", action="store_true", help="list the runs; runs nothing")
    options.add_argument("--draw-only", action="store_true", help="run nothing: tables and charts of what is there")
    given = options.parse_args(arguments)
    return carry_out(lambda: chart(given))


if __name__ == "__main__":
    sys.exit(main())
