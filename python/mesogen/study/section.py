"""A section of a report, filled by its Python file."""

import os
from dataclasses import dataclass, field

from ..figures import style
from ..runs.ledger import csv_text, write_file
from .verdict import Claim

MAP_RESOLUTION = 120  # dots per inch: small files, since reports are kept in the repository


@dataclass(frozen=True)
class Picture:
    """A picture and its numbers: names of files in the folder of the report."""

    file: str
    caption: str
    data: str = ""


@dataclass(frozen=True)
class Animation:
    """Frames that the browser plays: names of files in the folder of the report."""

    frames: tuple
    caption: str
    labels: tuple


@dataclass
class Section:
    """The content of a section, filled by `write(section)` of its file.

    name: of its file, without .py. folder: of the report. sweeps: {name: Results} of the sweeps in SWEEPS of its file.
    mode: "quick", "standard" or "full".
    """

    name: str
    title: str
    figure_of_paper: str
    folder: str
    sweeps: dict
    mode: str = "standard"
    parts: list = field(default_factory=list)  # texts, pictures, animations, tables, in the order of the report
    claims: list = field(default_factory=list)

    def runs(self, sweep):
        """The Results of a sweep; see results.py."""
        return self.sweeps[sweep]

    def text(self, words):
        """Adds a paragraph."""
        self.parts.append(words)

    def claim(self, text, verdict, numbers, remark=""):
        """Adds a Claim."""
        self.claims.append(Claim(text, verdict, numbers, remark))

    def picture(self, name, page, caption, columns=None, rows=None, quality=None):
        """Adds a figure, and its numbers as a CSV file.

        page: a matplotlib figure. columns, rows: of the CSV file. quality: of a JPEG file, for maps; None: a PNG file.
        """
        file = self._file(name, ".png" if quality is None else ".jpg")
        options = {} if quality is None else {"pil_kwargs": {"quality": quality}, "dpi": MAP_RESOLUTION}
        page.savefig(os.path.join(self.folder, file), **options)
        data = ""
        if columns is not None:
            data = self._file(name, ".csv")
            shortened = [[f"{value:.6g}" if isinstance(value, float) else value for value in row] for row in rows]
            write_file(os.path.join(self.folder, data), csv_text(columns, shortened))
        self.parts.append(Picture(file, caption, data))

    def animation(self, name, pages, labels, caption, quality=82):
        """Adds frames that the browser plays. pages: a matplotlib figure for each; labels: a text for each."""
        files = []
        for number, page in enumerate(pages):
            files.append(self._file(f"{name}_{number:03d}", ".jpg"))
            page.savefig(os.path.join(self.folder, files[-1]), pil_kwargs={"quality": quality}, dpi=style.RESOLUTION / 2)
        self.parts.append(Animation(tuple(files), caption, tuple(labels)))

    def table(self, columns, rows):
        """Adds a small table of texts."""
        self.parts.append((tuple(columns), [tuple(row) for row in rows]))

    def _file(self, name, ending):
        return f"{self.name}_{name}{ending}"
