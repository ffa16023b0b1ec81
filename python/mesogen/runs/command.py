"""What the commands mesogen chart, sweep and study share: options, messages and exit codes."""

import argparse
import signal
import sys

from ..errors import Interrupted, StudyError


def parser(verb, description):
    """An ArgumentParser with the options that the three commands have in common."""
    options = argparse.ArgumentParser(prog=f"mesogen {verb}", description=description)
    options.add_argument("-o", "--output", metavar="DIR", help="folder for everything that is written")
    options.add_argument("--quiet", action="store_true", help="no progress")
    options.add_argument("--mesogen", metavar="FILE", default="mesogen", help="the command that runs a case")
    return options


def tell(line):
    """Writes a message for the user to stderr."""
    print(line, file=sys.stderr, flush=True)


def show(text, files):
    """Prints a table and the names of the files that were written."""
    print(text)
    for file in files:
        print(f"wrote {file}")


def carry_out(action):
    """Calls action() and returns the exit code of the command.

    That is the value of action(), 0 for None; 1 if a file cannot be read or written; 2 for a StudyError; 130 if the
    user interrupted it.
    """
    signal.signal(signal.SIGTERM, _stop)
    if signal.getsignal(signal.SIGHUP) != signal.SIG_IGN:  # nohup ignores SIGHUP, and so must its runs
        signal.signal(signal.SIGHUP, _stop)
    try:
        return action() or 0
    except StudyError as error:
        tell(f"errors:\n{error}" if len(error.problems) > 1 else f"error: {error}")
        return 2
    except (Interrupted, KeyboardInterrupt):
        tell("interrupted: what was done is kept; the same command goes on")
        return 130
    except OSError as error:
        tell(f"error: {error}")
        return 1


def _stop(*_):
    raise Interrupted
