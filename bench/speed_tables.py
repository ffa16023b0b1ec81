"""Tables of bench/speed.py: what was measured as rows of text, a CSV of them, and pages that quote them.

A measurement is a Figure: a number in a table, at a row and a column that are named as they shall be read. So a table
is a pivot of its figures, rows and columns in the order in which they were measured.
"""

import csv
import re
import typing

COLUMNS = ["table", "row", "column", "value"]


class Figure(typing.NamedTuple):
    table: str
    row: str
    column: str
    value: typing.Union[float, str]


def row(table, name, columns):
    """Figures of one row: {column: value}."""
    return [Figure(table, name, column, value) for column, value in columns.items()]


def number_text(value):
    """Three digits, or the text itself."""
    if isinstance(value, str):
        return value
    if value == int(value) and abs(value) < 1e6:
        return f"{int(value)}"
    return f"{value:.3g}" if abs(value) < 1000 else f"{value:,.0f}"


def markdown(figures, table, corner):
    """The table of that name as lines of Markdown; `corner`: the header of its first column."""
    chosen = [figure for figure in figures if figure.table == table]
    rows, columns = (list(dict.fromkeys(getattr(figure, axis) for figure in chosen)) for axis in ("row", "column"))
    value = {(figure.row, figure.column): figure.value for figure in chosen}
    lines = [[corner, *columns], ["---"] * (len(columns) + 1)]
    for row in rows:
        lines.append([row, *(number_text(value[row, column]) if (row, column) in value else "" for column in columns)])
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def write_csv(file, figures):
    with open(file, "w", newline="", encoding="utf-8") as out:
        csv.writer(out, lineterminator="\n").writerows(
            [COLUMNS, *([*figure[:3], figure.value if isinstance(figure.value, str) else f"{figure.value:.6g}"]
                        for figure in figures)])


def read_csv(file):
    def value(text):
        try:
            return float(text)
        except ValueError:
            return text
    with open(file, newline="", encoding="utf-8") as rows:
        return [Figure(*row[:3], value(row[3])) for row in list(csv.reader(rows))[1:]]


def put_into(text, blocks):
    """A page in which what stands between `<!-- measured: NAME -->` and `<!-- end -->` is replaced by blocks[NAME].
    Raises ValueError if the page has no place for one of them."""
    for name, block in blocks.items():
        place = re.compile(rf"(<!-- measured: {re.escape(name)} -->\n).*?(<!-- end -->)", re.DOTALL)
        text, found = place.subn(lambda match, block=block: f"{match[1]}{block}\n{match[2]}", text)
        if found != 1:
            raise ValueError(f"the page has {found} places for the table '{name}': it needs one, "
                             f"<!-- measured: {name} --> ... <!-- end -->")
    return text
