"""scripts/device: proves that the code for NVIDIA GPUs is right, and measures how fast it is.

    scripts/device OUT            logs, results.json and summary.md go to the folder OUT
    scripts/device --pack KIT     a kit for a machine without the packages of Debian: a folder, or KIT.tar.gz
    KIT/device OUT                the same there

The exit code is 0 if all passed, 1 if something failed, 2 if it cannot begin, 3 if something was not run.
"""

import argparse
import datetime
import json
import os
import pathlib
import sys
import traceback

sys.path.insert(1, str(pathlib.Path(__file__).resolve().parents[1]))
import pack  # noqa: E402
from look import seen  # noqa: E402
from place import EMULATED, PROJECT, Place, Unusable, add_libraries_of_this_machine, scratch  # noqa: E402
from runner import run_stages  # noqa: E402
from stages import LIMIT, STAGES, stage  # noqa: E402
from verdicts import FAIL, NOT_RUN, NotRun, PASS, Report, exit_code, summary  # noqa: E402


def arguments():
    parser = argparse.ArgumentParser(prog="scripts/device", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter,
                                     epilog="Stages:\n" + "\n".join(f"  {one.name:10} {one.seconds:4.0f} s  {one.about}"
                                                                    for one in STAGES))
    parser.add_argument("out", nargs="?", type=pathlib.Path, metavar="OUT", help="folder for logs and results")
    parser.add_argument("--pack", type=pathlib.Path, metavar="KIT", help="pack a kit instead")
    parser.add_argument("--build", default=PROJECT / "build/release", type=pathlib.Path, metavar="DIR",
                        help="the build folder (default: build/release)")
    parser.add_argument("--only", action="append", choices=[one.name for one in STAGES], metavar="STAGE",
                        help="this stage alone; may be repeated. What `look` told before is kept in OUT")
    parser.add_argument("--limit", type=float, default=LIMIT, metavar="SECONDS",
                        help=f"for all stages (default: {LIMIT})")
    parser.add_argument("--stage", choices=[one.name for one in STAGES], help=argparse.SUPPRESS)
    options = parser.parse_args()
    if (options.out is None) == (options.pack is None):
        parser.error("give either OUT, a folder for the results, or --pack KIT")
    return options


def run_stage(name, place, out):
    """One stage, in a process of its own. Whatever goes wrong becomes a verdict."""
    report = Report(name, out / "parts" / f"{name}.jsonl")
    os.environ["TMPDIR"] = str(scratch(out, "temporary"))
    try:
        stage(name).run(place, out, report)
    except NotRun as reason:
        report.line("all", NOT_RUN, str(reason))
    except SystemExit as reason:  # of a command that failed
        report.line("all", FAIL, str(reason.code))
    except Exception as error:
        traceback.print_exc()
        report.line("all", FAIL, f"{type(error).__name__}: {error}")


def forget(out):
    """What stages of an earlier call left for later stages in the folder goes."""
    for pattern in ("look.json", "shares_*.json", "parts/*.jsonl"):
        for file in out.glob(pattern):
            file.unlink()


def run_all(place, options):
    """All stages; returns the exit code."""
    version = place.check()
    out = options.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    if options.only is None:
        forget(out)
    here = [sys.executable, "-B", pathlib.Path(__file__).parent, "--build", options.build, "--stage"]
    chosen = [one for one in STAGES if options.only is None or one.name in options.only]
    lines, figures, took = run_stages([(one.name, one.seconds) for one in chosen],
                                      lambda name: [*here, name, out], out, options.limit)
    if EMULATED:
        lines = [line._replace(verdict=f"{line.verdict}, emulated" if line.verdict == PASS else line.verdict)
                 for line in lines]
    device = seen(out).get("device", "no device")
    date = datetime.datetime.now().isoformat(" ", "minutes")
    heading = f"{version} on {device}, {date}, {sum(took.values()):.0f} s."
    if EMULATED:
        heading += " The host played the device: times say nothing of a GPU, and no goal of speed is judged."
    results = {"version": version, "device": device, "date": date, "emulated": EMULATED, "exit_code": exit_code(lines),
               "seconds": took, "lines": [line._asdict() for line in lines], "figures": figures}
    (out / "results.json").write_text(json.dumps(results, indent=1) + "\n", encoding="utf-8")
    text = summary(lines, heading)
    (out / "summary.md").write_text(text, encoding="utf-8")
    print(f"\n{text}\nLogs, results.json and summary.md are in {out}", flush=True)
    return exit_code(lines)


def main():
    options = arguments()
    try:
        place = Place(options.build)
        add_libraries_of_this_machine(place.kit)
        if options.pack is not None:
            pack.pack(place, options.pack)
            return 0
        if options.stage is not None:
            run_stage(options.stage, place, options.out.resolve())
            return 0
        return run_all(place, options)
    except (Unusable, NotRun) as problem:
        print(f"scripts/device: {problem}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
