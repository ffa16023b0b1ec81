"""A point of a chart: all runs of one variant at one resolution."""

import math
from dataclasses import dataclass
from statistics import median


@dataclass(frozen=True)
class Point:
    """Medians over repeats and seeds. If a run failed, `failure` says why, and error is NaN."""

    variant: str
    resolution: int
    error: float  # relative: 0.01 is 1 %
    wall: float  # s of stepping with its output, without start-up; of the whole process if a run failed
    wall_low: float
    wall_high: float
    cpu: float  # s
    steps: float
    memory: float  # bytes
    runs: int
    failure: str = ""

    @property
    def failed(self):
        return bool(self.failure)

    @property
    def name(self):
        return f"{self.variant} {self.resolution}"


def points_of(rows):
    """Points in the order of the rows' first appearance.

    rows: of runs.csv, those that belong to the study. A point has failed if one of its runs has.
    """
    groups = {}
    for row in rows:
        groups.setdefault((row["variant"], int(row["resolution"])), []).append(row)
    return [_point(variant, resolution, group) for (variant, resolution), group in groups.items()]


def _point(variant, resolution, rows):
    failures = [row for row in rows if row["status"] != "done"]
    walls = [_number(row["wall_seconds"]) for row in failures or rows]
    def middle(column):
        return median(_number(row[column]) for row in rows)
    if failures:
        return Point(variant, resolution, math.nan, median(walls), min(walls), max(walls), math.nan, math.nan, math.nan,
                     len(rows), failures[0]["reason"] or failures[0]["status"])
    return Point(variant, resolution, middle("error"), median(walls), min(walls), max(walls), middle("cpu_seconds"),
                 middle("steps"), middle("peak_memory"), len(rows))


def _number(text):
    return float(text) if text else math.nan
