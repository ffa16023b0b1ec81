"""One run of a sweep: begun, or gone on with where it was broken off."""

import datetime
import os
import shutil
import signal

from ..errors import MesogenError
from ..run import open as open_run
from ..study.errors import Refused, StudyError
from ..study.execution import Process, command
from ..study.machine import machine_text

FROM_OUTSIDE = (signal.SIGKILL, signal.SIGHUP, signal.SIGXCPU)  # memory ran out, the session ended: worth another try


class Attempt:
    """A run that goes on. Raises StudyError if another process is at it."""

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
            self.records.begin(self.run)  # not before: a checkpoint of another run must not lie below this key
            os.makedirs(os.path.dirname(folder), exist_ok=True)
            words = command(self.program, sweep.case, self.run.overrides, folder)
        self._process = Process(words, self.records.state(self.run, "errors"), sweep.threads, sweep.timeout,
                                gentle=True)

    def poll(self):
        """Its row once it has ended, None before. Raises StudyError if mesogen refuses it."""
        try:
            outcome = self._process.poll()
        except Refused:
            if not self.resumed:
                raise
            self.resumed = False  # none of its checkpoints can be used
            self._start()
            return None
        return None if outcome is None else self._row(outcome)

    def stop(self):
        """Ends it; it leaves a checkpoint. Without effect where it has ended."""
        try:
            self._process.stop()
        finally:
            self._lock.__exit__(None, None, None)

    def ask(self):
        """Lets it end soon; stop() is to follow."""
        self._process.ask()

    def _row(self, outcome):
        status = "killed" if outcome.signal in FROM_OUTSIDE else outcome.status
        row = {"key": self.run.key, "label": self.run.label, "status": status, "reason": outcome.reason,
               "wall_seconds": outcome.wall, "cpu_seconds": outcome.cpu, "machine": machine_text(),
               "version": self.records.version(self.run),
               "date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")}
        if outcome.status == "done":
            try:
                with open_run(self.records.results(self.run)) as run:
                    cost = run.cost
            except MesogenError as error:
                raise StudyError(f"{self.records.sweep.file}: {error}") from error
            row |= {"wall_seconds": cost.wall_seconds, "cpu_seconds": cost.cpu_seconds,
                    "steps": cost.steps, "peak_memory": cost.peak_memory}
        return row
