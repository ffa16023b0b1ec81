"""A section of a report: what its Python file puts into it."""

import csv
import io
import os
from dataclasses import dataclass, field

from ..figures import style
from .verdict import Claim


MAP_RESOLUTION = 120  # dots an inch: a report is kept in a repository


@dataclass(frozen=True)
class Picture:
    """A picture with its data, as files of the report's folder."""

    file: str
    caption: str
    data: str = ""


@dataclass(frozen=True)
class Animation:
    """Frames that the browser plays, as files of the report's folder."""

    frames: tuple
    caption: str
    labels: tuple


@dataclass
class Section:
    """What a section's `write(section)` fills.

    name: of its file, without .py. folder: of the report. sweeps: {name: Results} of the runs it asked for in SWEEPS.
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
        """Results of a sweep; see results.Results."""
        return self.sweeps[sweep]

    def text(self, words):
        """A paragraph."""
        self.parts.append(words)

    def claim(self, text, verdict, numbers, remark=""):
        """A claim of the paper, and whether it holds."""
        self.claims.append(Claim(text, verdict, numbers, remark))

    def picture(self, name, page, caption, columns=None, rows=None, quality=None):
        """A figure, and the numbers behind it as a CSV. page: a matplotlib figure made within style.settings().
        quality: of a JPEG, for maps; else it is a PNG."""
        file = self._file(name, ".png" if quality is None else ".jpg")
        options = {} if quality is None else {"pil_kwargs": {"quality": quality}, "dpi": MAP_RESOLUTION}
        page.savefig(os.path.join(self.folder, file), **options)
        data = ""
        if columns is not None:
            data = self._file(name, ".csv")
            stream = io.StringIO()
            writer = csv.writer(stream, lineterminator="\n")
            writer.writerow(columns)
            writer.writerows([[_short(value) for value in row] for row in rows])
            with open(os.path.join(self.folder, data), "w", encoding="utf-8") as out:
                out.write(stream.getvalue())
        self.parts.append(Picture(file, caption, data))

    def animation(self, name, pages, labels, caption, quality=82):
        """Frames that the browser plays, one page each; pages may be a generator."""
        files = []
        for number, page in enumerate(pages):
            files.append(self._file(f"{name}_{number:03d}", ".jpg"))
            page.savefig(os.path.join(self.folder, files[-1]), pil_kwargs={"quality": quality}, dpi=style.RESOLUTION / 2)
        self.parts.append(Animation(tuple(files), caption, tuple(labels)))

    def table(self, columns, rows):
        """A small table; its cells are texts."""
        self.parts.append((tuple(columns), [tuple(row) for row in rows]))

    def _file(self, name, ending):
        return f"{self.name}_{name}{ending}"


def _short(value):
    return f"{value:.6g}" if isinstance(value, float) else value
