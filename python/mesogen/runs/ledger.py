"""runs.csv, with one line for every run that ended, and other files of a folder of runs.

Lines are only appended, whole and synced to disk: a command that is killed loses at most the runs in progress.
"""

import contextlib
import csv
import fcntl
import io
import math
import os

from ..errors import StudyError


class Ledger:
    """The lines of one file: `rows`, each a dictionary of texts. Raises StudyError for a file with other columns."""

    def __init__(self, file, columns):
        self.file, self.columns = file, list(columns)
        self.rows = self._read()

    def _read(self):
        try:
            with open(self.file, encoding="utf-8", newline="") as stream:
                text = stream.read()
        except FileNotFoundError:
            return []
        whole = text[: text.rfind("\n") + 1]  # the command was killed while it wrote a line
        if len(whole) < len(text):
            with open(self.file, "r+b") as stream:
                stream.truncate(len(whole.encode()))
        rows = list(csv.reader(io.StringIO(whole)))
        if rows and rows[0] != self.columns:
            raise StudyError(f"{self.file}: its columns are not those of this version; move the file away, and all runs "
                             "are done again")
        for number, row in enumerate(rows[1:], start=2):
            if len(row) != len(self.columns):
                raise StudyError(f"{self.file}:{number}: has {len(row)} columns instead of {len(self.columns)}; remove "
                                 "the line, and its run is done again")
        return [dict(zip(self.columns, row, strict=True)) for row in rows[1:]]

    def add(self, row):
        """Appends a line from {column: value}; numbers keep all digits. The line is on disk when this returns."""
        values = ["" if row.get(name) is None else _text(row[name]) for name in self.columns]
        stream = io.StringIO()
        writer = csv.writer(stream, lineterminator="\n")
        if not os.path.exists(self.file) or os.path.getsize(self.file) == 0:
            writer.writerow(self.columns)
        writer.writerow(values)
        handle = os.open(self.file, os.O_WRONLY | os.O_APPEND | os.O_CREAT, 0o644)
        try:
            os.write(handle, stream.getvalue().encode())
            os.fsync(handle)
        finally:
            os.close(handle)
        self.rows.append(dict(zip(self.columns, values, strict=True)))


@contextlib.contextmanager
def locked(folder, busy=""):
    """A context manager that keeps other commands out of the folder, and makes it where there is none.

    Raises StudyError, with the text `busy` if it is given, if another command writes there.
    """
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, ".lock"), "w", encoding="ascii") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise StudyError(busy or f"another study is writing into {folder}; choose another folder with --output, "
                                     "or wait") from None
        yield folder


def write_file(path, text):
    """Writes a file as a whole: readers see the old text or the new one."""
    with open(path + ".tmp", "w", encoding="utf-8", newline="") as stream:
        stream.write(text)
    os.replace(path + ".tmp", path)


def csv_text(columns, rows):
    """The text of a CSV file. Numbers keep all digits; None and numbers that are not finite are left empty."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(columns)
    for row in rows:
        writer.writerow(["" if value is None or isinstance(value, float) and not math.isfinite(value) else _text(value)
                         for value in row])
    return stream.getvalue()


def stopped_too_early(row, timeout):
    """Whether a run that was stopped for its time has more time now. row: of runs.csv; timeout: s, or None."""
    return timeout is None or float(row["wall_seconds"]) < timeout


def _text(value):
    return repr(value) if isinstance(value, float) else " ".join(str(value).split("\n"))
