"""Progress of many runs: one line that is rewritten on a terminal, one line per finished run elsewhere."""

import os
import sys
import time

BAR = 20  # characters


def duration_text(seconds):
    """'3 h 05 min', '4 min 12 s', '8 s'"""
    whole = round(max(0.0, seconds))
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02} s"
    return f"{whole // 3600} h {whole % 3600 // 60:02} min"


def wall_text(seconds):
    """The duration of a finished run: '4 min 12 s', '0.23 s'"""
    return duration_text(seconds) if seconds >= 10 else f"{seconds:.2g} s"


class Progress:
    """Writes the progress of runs to stderr.

    total: number of runs; done: number of those that were finished before. quiet: writes nothing.
    """

    def __init__(self, total, done, quiet=False, stream=sys.stderr):
        self.total, self.done, self.quiet, self.stream = total, done, quiet, stream
        self.terminal = not quiet and stream.isatty()
        self.name = ""
        self.left = None
        self.begun = self.written = 0.0

    def start(self, name, left):
        """A run starts. left: expected s until all runs are done, or None."""
        self.name, self.left, self.begun = name, left, time.monotonic()
        self.written = 0.0
        self.tick()

    def tick(self):
        """Call this often during a run; it writes at most five times per second."""
        now = time.monotonic()
        if self.terminal and now - self.written >= 0.2:
            self.written = now
            width = os.get_terminal_size(self.stream.fileno()).columns
            self.stream.write("\r\033[K" + self.line(now - self.begun)[: width - 1])
            self.stream.flush()

    def end(self, text, name=""):
        """A run ended. text: how; name: which one, where several run at a time."""
        self.done += 1
        if not self.quiet:
            clear = "\r\033[K" if self.terminal else ""
            digits = len(str(self.total))
            self.stream.write(f"{clear}{self.done:{digits}} of {self.total}  {name or self.name}: {text}\n")
            self.stream.flush()

    def close(self):
        """Removes the line from the terminal."""
        if self.terminal:
            self.stream.write("\r\033[K")
            self.stream.flush()

    def line(self, running):
        """The line on a terminal. running: s since the run started."""
        full = BAR * self.done // self.total
        text = f"[{'#' * full}{'.' * (BAR - full)}] {self.done + 1} of {self.total}  {self.name}  {duration_text(running)}"
        return text + (f"  about {duration_text(self.left - running)} left" if self.left else "")
