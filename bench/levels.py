#!/usr/bin/python3
"""The cheapest variant of each scene for each error, in one table, from the charts that scripts/accuracy made.

    bench/levels.py output/charts docs/accuracy/levels.md

Reads points.csv of every study of studies/accuracy under the folder; scenes that are not there are left out.
"""

import csv
import glob
import math
import os
import sys

PROJECT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(PROJECT, "python"))

from mesogen.charts.analysis import LEVELS, by_variant, cheapest, reach  # noqa: E402
from mesogen.charts.points import Point  # noqa: E402
from mesogen.charts.tables import percent, seconds  # noqa: E402
from mesogen.runs.markdown import table_lines  # noqa: E402

PUBLISHED, EULERIAN = "published", "eulerian"
HEAD = """# The cheapest variant for each error

This table gives, for each scene and each error that you accept, the cheapest variant and its wall time on one core, s.
Times are interpolated between measured points, never beyond them. If particles that do not move (`eulerian`) are the
cheapest, the table also gives the cheapest variant whose particles move. In brackets: the time of the default and of
the published scheme, "-" if no resolution that was run stays within the error. Variants are those of
`studies/accuracy/variants`. `scripts/accuracy` writes this page.
"""


def number(text):
    return float(text) if text else math.nan


def points_of(file):
    """The points of a study's points.csv."""
    with open(file, newline="", encoding="utf-8") as lines:
        return [Point(row["variant"], int(row["resolution"]), number(row["error"]), number(row["wall_seconds"]),
                      number(row["wall_seconds_min"]), number(row["wall_seconds_max"]), number(row["cpu_seconds"]),
                      number(row["steps"]), number(row["peak_memory"]), int(row["runs"]), row["failure"])
                for row in csv.DictReader(lines)]


def cell(points, level):
    """`eulerian` 0.09, `wendland_c2` 0.2 (0.33; -): the best, and the best of those that move if it does not."""
    best = [one for one in (cheapest(points, level), cheapest([p for p in points if p.variant != EULERIAN], level)) if one]
    if not best:
        return "none"
    first = ", ".join(dict.fromkeys(f"`{one.variant}` {seconds(one.wall)}" for one in best))
    others = [reach(by_variant(points).get(name, []), level) for name in ("default", PUBLISHED)]
    if PUBLISHED not in by_variant(points):
        others.pop()
    return f"{first} ({'; '.join(seconds(one.wall) if one else '-' for one in others)})"


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    charts, output = sys.argv[1:]
    rows = []
    for study in sorted(glob.glob(os.path.join(PROJECT, "studies", "accuracy", "*.toml"))):
        name = os.path.splitext(os.path.basename(study))[0]
        file = os.path.join(charts, name, "points.csv")
        if os.path.exists(file):
            points = points_of(file)
            rows.append([f"[{name.replace('_', ' ')}]({name}/table.md)", *(cell(points, level) for level in LEVELS)])
    header = ["scene", *(percent(level) for level in LEVELS)]
    with open(output, "w", encoding="utf-8") as page:
        page.write(HEAD + "\n" + "\n".join(table_lines(header, rows, left=header)) + "\n")


if __name__ == "__main__":
    main()
