"""Pictures of a run: python3 -m mesogen.report DIR [--frame N | --frames A:B] [--every N] [--output DIR]."""

import argparse
import os
import re
import sys

from .errors import MesogenError, NoSuchName
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


def report(folder, frame=-1, output=None, frames=None, every=None):
    """Draw all that a run's results allow.

    folder: the run's folder, or its results.h5. frame: the frame drawn, negative from the end. output: where the PNGs
    go, by default `report` in the run's folder.
    frames: (first, last), both drawn and negative from the end, None for the first or the last stored; every: each
    n-th of them. With one of these, all those frames are drawn, each to files of its own: director_000012.png.
    Yields (file, None) for a picture written, (file, reason) for one left out. Raises MesogenError if there are no
    results or no such frame, or if the folder for the pictures holds files but none of a report.
    """
    with open_run(folder) as run:
        target = output or os.path.join(run.folder, "report")
        if problem := foreign(target, lambda names: any(_is_picture(name) for name in names)):
            raise MesogenError(problem)
        if frames is None and every is None:
            yield from _pictures(Scene(run, frame if len(run.times) else None), target, "")
            return
        for number in chosen_frames(run, frames or (None, None), every or 1):
            yield from _pictures(Scene(run, number), target, f"_{number:06}")


def _is_picture(name):
    """Does a file of this name come from a report: vorticity.png, vorticity_000012.png?"""
    return any(re.fullmatch(rf"{figure}(_\d{{6,}})?\.png", name) for figure in FIGURES)


def chosen_frames(run, frames, every):
    """Numbers of the frames from frames[0] to frames[1], each `every`-th. Raises NoSuchName where there are none."""
    first, last = (run.frame_index(at if at is not None else end) for at, end in zip(frames, (0, -1)))
    if first > last:
        raise NoSuchName(f"no frames from {first} to {last}; name the earlier one first")
    return range(first, last + 1, every)


def _pictures(scene, target, ending):
    os.makedirs(target, exist_ok=True)
    with style.settings():
        for name, figure in FIGURES.items():
            file = os.path.join(target, f"{name}{ending}.png")
            reason = figure.lacking(scene)
            if reason is None:
                figure.figure(scene).savefig(file)
            yield file, reason


def _span(text):
    """"A:B" as a pair of numbers, None for one that is left out."""
    parts = text.split(":")
    if len(parts) != 2:
        raise argparse.ArgumentTypeError(f"'{text}' must be A:B, such as 10:20, 10: or :-5")
    try:
        return tuple(int(part) if part else None for part in parts)
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}' must be A:B with whole numbers, such as 10:20, 10: or :-5") from None


def _count(text):
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"'{text}' must be a whole number, at least 1")
    return int(text)


def main(arguments=None):
    """The command. Returns its exit code: 0, 1 if a picture cannot be written, 2 if there are no such results."""
    parser = argparse.ArgumentParser(
        prog="mesogen report",
        description="Draws the results of a run: director, vorticity, pathlines, mixing, time series and a summary.",
    )
    parser.add_argument("folder", metavar="DIR", help="folder of a run, as given to 'mesogen run --output'")
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--frame", type=int, help="frame to draw; negative: from the end (default: last)")
    which.add_argument("--frames", type=_span, metavar="A:B",
                       help="draw frames A to B, both included; A or B may be left out, negative: from the end")
    parser.add_argument("--every", type=_count, metavar="N", help="draw each N-th frame, of all or of --frames")
    parser.add_argument("--output", metavar="DIR", help="folder for the pictures (default: DIR/report)")
    options = parser.parse_args(arguments)
    if options.frame is not None and options.every is not None:
        parser.error("argument --every: not allowed with argument --frame")
    frame = -1 if options.frame is None else options.frame
    told = set()
    try:
        for file, reason in report(options.folder, frame, options.output, options.frames, options.every):
            if reason is None:
                print(f"wrote {file}", flush=True)
            elif reason not in told:  # once for all frames
                print(f"left out {os.path.basename(file)}: {reason}", flush=True)
                told.add(reason)
    except MesogenError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
