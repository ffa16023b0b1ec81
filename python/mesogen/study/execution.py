"""One run as a process of its own: `mesogen run CASE --set ... --output FOLDER`."""

import contextlib
import ctypes
import json
import os
import shlex
import shutil
import signal
import subprocess
import time
from dataclasses import dataclass

from .errors import Interrupted, Refused
from .overrides import set_texts

PAUSE = 0.02  # s between two looks whether a run is over
PATIENCE = 60.0  # s that a run has to end by itself: a step and a checkpoint


@dataclass(frozen=True)
class Outcome:
    """How a run ended. `status`: done, failed or timeout."""

    status: str
    reason: str  # the first line of its errors; empty if it is done
    wall: float  # s, of the whole process
    cpu: float  # s, user and system, of the whole process
    signal: int = 0  # that ended it


def command(program, case, overrides, folder):
    """The run as a list of words."""
    words = [program, "run", case]
    for text in set_texts(overrides):
        words += ["--set", text]
    return [*words, "--output", folder]


def command_line(program, case, overrides, folder, threads):
    """The same as one line for a shell."""
    return shlex.join([*command(program, case, overrides, folder), "--threads", str(threads)])


class Process:
    """A run that goes on: mesogen with some words.

    errors: file that what it says goes to until it has ended. timeout: s of wall time, or None. gentle: a run that is
    to end is asked first, and writes a checkpoint; it then has PATIENCE to do so.
    """

    def __init__(self, words, errors, threads=1, timeout=None, gentle=False):
        self.words, self.errors, self.timeout, self.gentle = words, errors, timeout, gentle
        self._asked = None
        self._late = False
        environment = {**os.environ, "OMP_NUM_THREADS": str(threads)}
        with open(errors, "wb") as stream:
            self._begun = time.monotonic()
            # In a group of its own: Ctrl-C is for the study, which then ends its runs, each once.
            self._process = subprocess.Popen([*words, "--quiet"], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                             stderr=stream, env=environment, preexec_fn=_die_with_parent,
                                             process_group=0)

    def poll(self):
        """An Outcome once it has ended, None before. Raises Refused where mesogen does not take the case, and
        Interrupted if the run was interrupted by somebody else."""
        now = time.monotonic()
        if self.timeout is not None and not self._late and now - self._begun > self.timeout:
            self._late = True
            self.ask()
        if self._asked is not None and now - self._asked > PATIENCE:
            self._signal(signal.SIGKILL)
        ended, status, usage = os.wait4(self._process.pid, os.WNOHANG)
        return self._outcome(status, usage) if ended else None

    def ask(self):
        """Lets it end soon; poll() or stop() is to follow."""
        if self._asked is None:
            self._asked = time.monotonic()
            self._signal(signal.SIGTERM if self.gentle else signal.SIGKILL)

    def stop(self):
        """Ends it and waits until it has."""
        if self._process.returncode is not None:
            return
        self.ask()
        with contextlib.suppress(ChildProcessError):  # it was waited for when an interrupt came
            while not os.waitpid(self._process.pid, os.WNOHANG)[0]:
                if time.monotonic() - self._asked > PATIENCE:
                    self._signal(signal.SIGKILL)
                time.sleep(PAUSE)
        self._closed()

    def _signal(self, number):
        # Not Popen.send_signal: that waits for the process, and what it took would be lost.
        with contextlib.suppress(ProcessLookupError):
            os.kill(self._process.pid, number)

    def _closed(self):
        self._process.returncode = 0  # waited for: subprocess has nothing left to do
        with open(self.errors, encoding="utf-8", errors="replace") as stream:
            text = stream.read()
        os.remove(self.errors)
        return text

    def _outcome(self, status, usage):
        wall = time.monotonic() - self._begun
        text = self._closed()
        code = os.waitstatus_to_exitcode(status)
        cpu = usage.ru_utime + usage.ru_stime
        if self._late and code != 0:
            return Outcome("timeout", f"took longer than {self.timeout:g} s", wall, cpu)
        if code == 130:
            raise Interrupted
        if code in (2, 3):
            raise Refused(f"mesogen refuses {self.words[2]}:\n" + _without_prefix(text))
        if code == 0:
            return Outcome("done", "", wall, cpu)
        return Outcome("failed", _reason(text, code), wall, cpu, max(0, -code))


def execute(program, case, overrides, folder, threads=1, timeout=None, tick=None):
    """Runs the case into `folder`, which is emptied first.

    timeout: s of wall time, or None. tick: called some times a second while the run goes on.
    Returns an Outcome. Raises StudyError if mesogen refuses the case, with its own words, and Interrupted if the run
    was interrupted.
    """
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(os.path.dirname(folder) or ".", exist_ok=True)
    process = Process(command(program, case, overrides, folder), folder + ".err", threads, timeout)
    try:
        while (outcome := process.poll()) is None:
            if tick:
                tick()
            time.sleep(PAUSE)
    except BaseException:
        process.stop()
        raise
    return outcome


def refusals(program, case, changes, unfit=lambda recorded: ()):
    """What is said against the case with some changes: {line: [names]}, nothing if all can be run.

    changes: {name: overrides}. unfit: called with what the observers of a case that mesogen takes will record,
    {observer: {quantity: columns}} with 0 columns for a single number; gives lines against it. Nothing is run.
    """
    said = {}
    for name, overrides in changes.items():
        refused, recorded = _look(program, case, overrides)
        for line in [*refused.splitlines(), *(() if refused else unfit(recorded))]:
            said.setdefault(line, []).append(name)
    return said


def _look(program, case, overrides):
    """What mesogen says against the case, "" if it can be run, and what its observers will record."""
    words = [program, "quantity", "list", "--json", case]
    for text in set_texts(overrides):
        words += ["--set", text]
    done = subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return _without_prefix(done.stderr), {}
    return "", {observer: {name: one["columns"] for name, one in quantities.items()}
                for observer, quantities in json.loads(done.stdout).items()}


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
