"""One run as a process of its own: `mesogen run CASE --set ... --output FOLDER`."""

import ctypes
import os
import shlex
import shutil
import signal
import subprocess
import time
from dataclasses import dataclass

from .errors import Interrupted, StudyError
from .overrides import set_texts

PAUSE = 0.02  # s between two looks whether a run is over


@dataclass(frozen=True)
class Outcome:
    """How a run ended. `status`: done, failed or timeout."""

    status: str
    reason: str  # the first line of its errors; empty if it is done
    wall: float  # s, of the whole process
    cpu: float  # s, user and system, of the whole process


def command(program, case, overrides, folder):
    """The run as a list of words."""
    words = [program, "run", case]
    for text in set_texts(overrides):
        words += ["--set", text]
    return [*words, "--output", folder]


def command_line(program, case, overrides, folder, threads):
    """The same as one line for a shell."""
    return shlex.join([*command(program, case, overrides, folder), "--threads", str(threads)])


def execute(program, case, overrides, folder, threads=1, timeout=None, tick=None):
    """Runs the case into `folder`, which is emptied first.

    timeout: s of wall time, or None. tick: called some times a second while the run goes on.
    Returns an Outcome. Raises StudyError if mesogen refuses the case, with its own words, and Interrupted if the run
    was interrupted.
    """
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(os.path.dirname(folder) or ".", exist_ok=True)
    words = [*command(program, case, overrides, folder), "--quiet"]
    errors = folder + ".err"
    environment = {**os.environ, "OMP_NUM_THREADS": str(threads)}
    with open(errors, "wb") as stream:
        begun = time.monotonic()
        process = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=stream,
                                   env=environment, preexec_fn=_die_with_parent)
        late = False
        try:
            while True:
                ended, status, usage = os.wait4(process.pid, os.WNOHANG)
                if ended:
                    break
                if timeout is not None and not late and time.monotonic() - begun > timeout:
                    late = True
                    process.kill()
                if tick:
                    tick()
                time.sleep(PAUSE)
        except BaseException:
            process.kill()
            os.waitpid(process.pid, 0)
            raise
        finally:
            process.returncode = 0  # waited for: subprocess has nothing left to do
    wall = time.monotonic() - begun
    with open(errors, encoding="utf-8", errors="replace") as stream:
        text = stream.read()
    os.remove(errors)
    code = os.waitstatus_to_exitcode(status)
    cpu = usage.ru_utime + usage.ru_stime
    if late:
        return Outcome("timeout", f"took longer than {timeout:g} s", wall, cpu)
    if code == 130:
        raise Interrupted
    if code in (2, 3):
        raise StudyError(f"mesogen refuses {case}:\n" + _without_prefix(text))
    return Outcome("done" if code == 0 else "failed", "" if code == 0 else _reason(text, code), wall, cpu)


def refusal(program, case, overrides):
    """What mesogen says against the case, "" if it can be run. Nothing is run."""
    words = [program, "graph", case]
    for text in set_texts(overrides):
        words += ["--set", text]
    done = subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    return "" if done.returncode == 0 else _without_prefix(done.stderr)


def _die_with_parent():
    # A study that is killed leaves no run behind that would go on writing. 1: PR_SET_PDEATHSIG
    ctypes.CDLL(None).prctl(1, signal.SIGKILL)


def _without_prefix(text):
    """The errors without "error: " or "errors:" before them, and without warnings."""
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("warning: ")]
    if lines and lines[0] == "errors:":
        lines = lines[1:]
    return "\n".join(line.removeprefix("error: ") for line in lines)


def _reason(text, code):
    if code < 0:
        return f"was ended by {signal.Signals(-code).name}"
    lines = _without_prefix(text).splitlines()
    return lines[0] if lines else f"ended with exit code {code}"
