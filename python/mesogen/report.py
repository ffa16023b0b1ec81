"""Pictures of a run: python3 -m mesogen.report DIR [--frame N] [--output DIR]."""

import argparse
import os
import sys

from .errors import MesogenError
from .figures import director, mixing, pathlines, series, style, summary, vorticity
from .figures.scene import Scene
from .output_folder import foreign
from .run import open as open_run

FIGURES = {
    "director": director,
    "vorticity": vorticity,
    "pathlines": pathlines,
    "mixing": mixing,
    "series": series,
    "summary": summary,
}


def report(folder, frame=-1, output=None):
    """Draw all that a run's results allow.

    folder: the run's folder, or its results.h5. frame: the frame drawn, negative from the end. output: where the PNGs
    go, by default `report` in the run's folder.
    Yields (file, None) for a picture written, (file, reason) for one left out. Raises MesogenError if there are no
    results or no such frame, or if the folder for the pictures holds files but none of a report.
    """
    with open_run(folder) as run:
        target = output or os.path.join(run.folder, "report")
        frames = len(run.times)
        scene = Scene(run, frame if frames else None)
        if problem := foreign(target, lambda names: any(f"{name}.png" in names for name in FIGURES)):
            raise MesogenError(problem)
        os.makedirs(target, exist_ok=True)
        with style.settings():
            for name, figure in FIGURES.items():
                file = os.path.join(target, f"{name}.png")
                reason = figure.lacking(scene)
                if reason is None:
                    figure.figure(scene).savefig(file)
                yield file, reason


def main(arguments=None):
    """The command. Returns its exit code: 0, 1 if a picture cannot be written, 2 if there are no such results."""
    parser = argparse.ArgumentParser(
        prog="mesogen report",
        description="Draws the results of a run: director, vorticity, pathlines, mixing, time series and a summary.",
    )
    parser.add_argument("folder", metavar="DIR", help="folder of a run, as given to 'mesogen run --output'")
    parser.add_argument("--frame", type=int, default=-1, help="frame to draw; negative: from the end (default: last)")
    parser.add_argument("--output", metavar="DIR", help="folder for the pictures (default: DIR/report)")
    options = parser.parse_args(arguments)
    try:
        for file, reason in report(options.folder, options.frame, options.output):
            print(f"wrote {file}" if reason is None else f"left out {os.path.basename(file)}: {reason}", flush=True)
    except MesogenError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
