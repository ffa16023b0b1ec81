"""One run as one process: `mesogen run CASE --set ... --output FOLDER`."""

import contextlib
import ctypes
import os
import shlex
import shutil
import signal
import subprocess
import time
from dataclasses import dataclass

from ..errors import Interrupted, MesogenError, Refused, StudyError
from ..run import open as open_run
from .overrides import set_arguments

PAUSE = 0.02  # s between two looks whether a run is over
PATIENCE = 60.0  # s that a run has for its last step and its checkpoint before it is killed


@dataclass(frozen=True)
class Outcome:
    """How a run ended. `status`: "done", "failed" or "timeout"."""

    status: str
    reason: str  # the first line of its errors, "" if it is done
    wall: float  # s of wall time, of the whole process
    cpu: float  # s of processor time, user and system, of the whole process
    signal: int = 0  # number of the signal that ended it, 0 if none did


def command(program, case, overrides, folder):
    """The command of a run, as a list of words."""
    return [program, "run", case, *set_arguments(overrides), "--output", folder]


def launched(words, ranks):
    """The command as so many processes share it."""
    return words if ranks == 1 else ["mpirun", "--bind-to", "none", "-n", str(ranks), *words]


def command_line(program, case, overrides, folder, threads, ranks=1):
    """The command of a run, as one line for a shell."""
    return shlex.join(launched([*command(program, case, overrides, folder), "--threads", str(threads)], ranks))


class Process:
    """A run in progress.

    words: its command. errors: file for its error messages, removed at its end. timeout: s of wall time, or None.
    gentle: a run that has to end is told by a signal, and has PATIENCE seconds to write a checkpoint; without it, it is killed.
    ranks: processes that share the run.
    """

    def __init__(self, words, errors, threads=1, timeout=None, gentle=False, ranks=1):
        self.words, self.errors, self.timeout, self.gentle = words, errors, timeout, gentle
        # mpirun passes SIGUSR1 on; told to end itself, it would kill the ranks a second later.
        self._gently = signal.SIGTERM if ranks == 1 else signal.SIGUSR1
        self._asked = None
        self._late = False
        environment = {**os.environ, "OMP_NUM_THREADS": str(threads)}
        with open(errors, "wb") as stream:
            self._begun = time.monotonic()
            # A process group of its own: Ctrl-C reaches this process alone, which then ends each run once.
            self._process = subprocess.Popen(launched([*words, "--quiet"], ranks), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                             stderr=stream, env=environment, preexec_fn=_die_with_parent,
                                             process_group=0)

    def poll(self):
        """The Outcome after its end, None before. Raises Refused if mesogen refuses the case, and Interrupted if
        somebody else interrupted the run."""
        now = time.monotonic()
        if self.timeout is not None and not self._late and now - self._begun > self.timeout:
            self._late = True
            self.ask()
        if self._asked is not None and now - self._asked > PATIENCE:
            self._signal(signal.SIGKILL)
        ended, status, usage = os.wait4(self._process.pid, os.WNOHANG)
        return self._outcome(status, usage) if ended else None

    def ask(self):
        """Asks it to end, without waiting; call poll() or stop() next."""
        if self._asked is None:
            self._asked = time.monotonic()
            self._signal(self._gently if self.gentle else signal.SIGKILL)

    def stop(self):
        """Ends it and waits for its end. Does nothing after its end."""
        if self._process.returncode is not None:
            return
        self.ask()
        with contextlib.suppress(ChildProcessError):  # an interrupt came while poll() reaped it
            while not os.waitpid(self._process.pid, os.WNOHANG)[0]:
                if time.monotonic() - self._asked > PATIENCE:
                    self._signal(signal.SIGKILL)
                time.sleep(PAUSE)
        self._closed()

    def _signal(self, number):
        # Not Popen.send_signal: it may reap the process, and its times would be lost.
        with contextlib.suppress(ProcessLookupError):
            os.kill(self._process.pid, number)

    def _closed(self):
        self._process.returncode = 0  # reaped here, so that subprocess does not wait for it
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
            raise Refused(f"mesogen refuses {self.words[2]}:\n" + without_prefix(text))
        if code == 0:
            return Outcome("done", "", wall, cpu)
        return Outcome("failed", _reason(text, code), wall, cpu, max(0, -code))


@contextlib.contextmanager
def results_of(folder, file):
    """A context manager of the mesogen.Run in a folder; what it lacks is a StudyError about the study `file`."""
    try:
        with open_run(folder) as run:
            yield run
    except MesogenError as error:
        raise StudyError(f"{file}: {error}") from error


def execute(program, case, overrides, folder, threads=1, timeout=None, tick=None):
    """Runs the case into `folder`, which is emptied first, and returns the Outcome.

    timeout: s of wall time, or None. tick: called many times per second during the run, or None.
    Raises Refused with mesogen's own words if it refuses the case, and Interrupted if the run was interrupted.
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


def _die_with_parent():
    # If this process is killed, no run stays behind and writes. 1: PR_SET_PDEATHSIG
    ctypes.CDLL(None).prctl(1, signal.SIGKILL)


def without_prefix(text):
    """Error messages of mesogen without warnings and without "error: " or "errors:" before them, and without what
    mpirun adds: all from its line of dashes on."""
    text = text.split("-" * 60)[0]
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("warning: ")]
    if lines and lines[0] == "errors:":
        lines = lines[1:]
    return "\n".join(line.removeprefix("error: ") for line in lines)


def _reason(text, code):
    if code < 0:
        return f"was ended by {signal.Signals(-code).name}"
    lines = without_prefix(text).splitlines()
    return lines[0] if lines else f"ended with exit code {code}"
