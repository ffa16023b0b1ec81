"""What the commands mesogen chart, sweep and study have in common: how they end."""

import signal
import sys

from .errors import Interrupted, StudyError


def carry_out(action):
    """Does action() and returns the exit code: its own, or 0 if it has none; 1 if a file cannot be written; 2 if what was
    asked for is wrong; 130 if it was interrupted."""
    signal.signal(signal.SIGTERM, _stop)
    if signal.getsignal(signal.SIGHUP) != signal.SIG_IGN:  # as nohup wants it
        signal.signal(signal.SIGHUP, _stop)
    try:
        return action() or 0
    except StudyError as error:
        print(f"errors:\n{error}" if len(error.problems) > 1 else f"error: {error}", file=sys.stderr)
        return 2
    except (Interrupted, KeyboardInterrupt):
        print("interrupted: what was done is kept; the same command goes on", file=sys.stderr)
        return 130
    except OSError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1


def _stop(*_):
    raise Interrupted
