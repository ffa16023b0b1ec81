"""How far a study is: on a terminal one line, rewritten; elsewhere a line for each run."""

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


class Progress:
    """Tells of runs on stderr.

    total: how many runs there are; done: how many of them were there before.
    """

    def __init__(self, total, done, quiet=False, stream=sys.stderr):
        self.total, self.done, self.quiet, self.stream = total, done, quiet, stream
        self.terminal = not quiet and stream.isatty()
        self.name = ""
        self.left = None
        self.begun = self.written = 0.0

    def start(self, name, left):
        """A run begins. left: expected s until all is done, None if nobody knows."""
        self.name, self.left, self.begun = name, left, time.monotonic()
        self.written = 0.0
        self.tick()

    def tick(self):
        """While a run goes on; writes seldom."""
        now = time.monotonic()
        if self.terminal and now - self.written >= 0.2:
            self.written = now
            width = os.get_terminal_size(self.stream.fileno()).columns
            self.stream.write("\r\033[K" + self.line(now - self.begun)[: width - 1])
            self.stream.flush()

    def end(self, text, name=""):
        """A run ended; `text` says how, `name` which where several go on at a time."""
        self.done += 1
        if not self.quiet:
            clear = "\r\033[K" if self.terminal else ""
            digits = len(str(self.total))
            self.stream.write(f"{clear}{self.done:{digits}} of {self.total}  {name or self.name}: {text}\n")
            self.stream.flush()

    def close(self):
        """Leaves the terminal with a complete line."""
        if self.terminal:
            self.stream.write("\r\033[K")
            self.stream.flush()

    def line(self, running):
        """The line on a terminal; running: s since the run began."""
        full = BAR * self.done // self.total
        text = f"[{'#' * full}{'.' * (BAR - full)}] {self.done + 1} of {self.total}  {self.name}  {duration_text(running)}"
        return text + (f"  about {duration_text(self.left - running)} left" if self.left else "")
