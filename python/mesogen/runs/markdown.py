"""Tables in Markdown, aligned so that they are readable on a terminal too."""

from .program import split_version


def table_lines(header, rows, left=()):
    """The lines of a table. left: names of columns that are aligned to the left, the others to the right."""
    cells = [list(header), *([str(cell).replace("|", "\\|") for cell in row] for row in rows)]
    widths = [max(3, *(len(row[i]) for row in cells)) for i in range(len(header))]
    leftmost = [name in left for name in header]

    def line(row):
        return "| " + " | ".join(c.ljust(w) if to_left else c.rjust(w)
                                 for c, w, to_left in zip(row, widths, leftmost, strict=True)) + " |"

    rule = "|".join("-" * (w + 2) if to_left else "-" * (w + 1) + ":"
                    for w, to_left in zip(widths, leftmost, strict=True))
    return [line(cells[0]), f"|{rule}|", *(line(row) for row in cells[1:])]


def head_lines(rows):
    """Lines with machine, version and dates of runs. rows: of runs.csv."""
    lines = []
    for what, column in (("Machine", "machine"), ("Mesogen", "version")):
        found = sorted({split_version(row[column])[0] for row in rows})
        lines += [f"{what}: {'; '.join(found)}" + (" (MIXED: times are not comparable)" if len(found) > 1 else ""), ""]
    dates = sorted({row["date"][:10] for row in rows})
    span = dates[0] if len(dates) == 1 else f"{dates[0]} to {dates[-1]}"
    return [*lines, f"Run on {span}."]
