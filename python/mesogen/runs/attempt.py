"""One run of a sweep: started, or resumed from its checkpoint."""

import os
import shutil
import signal

from ..errors import Refused
from .execution import Process, command, results_of
from .program import stamp

# Signals for which a run is not to blame: memory ran out, the terminal was closed. It is worth another try.
FROM_OUTSIDE = (signal.SIGKILL, signal.SIGHUP, signal.SIGXCPU)


class Attempt:
    """A run in progress. Raises StudyError if another process is doing it. `resumed`: whether it has a checkpoint."""

    def __init__(self, records, run):
        self.records, self.run, self.program = records, run, records.program.command
        self._lock = records.locked(run)
        self._lock.__enter__()
        try:
            self.resumed = records.can_go_on(run)
            self._start()
        except BaseException:
            self._lock.__exit__(None, None, None)
            raise

    def _start(self):
        sweep, folder = self.records.sweep, self.records.results(self.run)
        if self.resumed:
            words = [self.program, "resume", folder]
        else:
            shutil.rmtree(folder, ignore_errors=True)
            self.records.begin(self.run)  # only now: no checkpoint of another run may lie there under this key
            os.makedirs(os.path.dirname(folder), exist_ok=True)
            words = command(self.program, sweep.case, self.run.overrides, folder)
        self._process = Process(words, self.records.state(self.run, "errors"), sweep.threads, sweep.timeout,
                                gentle=True, ranks=sweep.ranks)

    def poll(self):
        """Its row of runs.csv after its end, None before. Raises StudyError if mesogen refuses it."""
        try:
            outcome = self._process.poll()
        except Refused:
            if not self.resumed:
                raise
            self.resumed = False  # it has no usable checkpoint: start again
            self._start()
            return None
        return None if outcome is None else self._row(outcome)

    def stop(self):
        """Ends it with a checkpoint. Does nothing to the run after its end. Must be called once in any case."""
        try:
            self._process.stop()
        finally:
            self._lock.__exit__(None, None, None)

    def ask(self):
        """Asks it to end, without waiting; call stop() next."""
        self._process.ask()

    def _row(self, outcome):
        status = "killed" if outcome.signal in FROM_OUTSIDE else outcome.status
        row = {"key": self.run.key, "label": self.run.label, "status": status, "reason": outcome.reason,
               "wall_seconds": outcome.wall, "cpu_seconds": outcome.cpu, **stamp(self.records.version(self.run))}
        if outcome.status == "done":
            with results_of(self.records.results(self.run), self.records.sweep.file) as run:
                cost = run.cost
            row |= {"wall_seconds": cost.wall_seconds, "cpu_seconds": cost.cpu_seconds,
                    "steps": cost.steps, "peak_memory": cost.peak_memory}
        return row
