"""A sweep as a TOML file:

    title = "Speed against activity"
    case = "../cases/active_turbulence/extensile.toml"  # relative to this file
    seeds = [1, 2, 3]                       # optional: each point is run once per seed
    seed_keys = ["director.seed"]           # optional: keys of the case that take the seed; this is the default
    threads = 1                             # of each run; of each rank, if there are several
    ranks = 1                               # processes that share each run
    parallel = "auto"                       # runs at a time; auto: number of cores / (threads x ranks)
    timeout = 3600                          # s of wall time, optional: a run that takes longer is stopped
    [common]                                # optional: changed in all runs, dotted and quoted
    "time.end" = 600.0
    [grid]                                  # every combination of these is a point
    "physics.activity.activity" = [0.01, 0.02, 0.05]
    [point.strong]                          # further points, by name
    "physics.activity.activity" = 0.3
    [[quantity]]                            # what is collected: one or more
    series = "flow.vorticity_rms"           # the observer's name in the case, and its quantity: one number a sample
    from = 300.0                            # s: samples after this time; the default is the start
    until = 600.0                           # s, optional: and not after this one
    blocks = 6                              # optional: of time, for the error within a run; see statistics.py
    name = "late vorticity"                 # optional, for the table
"""

import math
import os
from dataclasses import dataclass

from ..errors import StudyError
from .conflicts import conflicts
from .overrides import digest, read_overrides
from .points import Point, grid_points, named_points
from .table_reader import TableReader, read_toml


@dataclass(frozen=True)
class Quantity:
    """A series, and the span of time that it is averaged over: start < t <= end, in the time unit of the case."""

    name: str
    observer: str
    series: str
    start: float
    end: float
    blocks: int | None


@dataclass(frozen=True)
class Run:
    """One run. label: name of its folder; key: a digest of the case and its overrides."""

    label: str
    point: Point
    seed: int | None
    overrides: dict
    key: str


@dataclass(frozen=True)
class Sweep:
    """A sweep. case: path of the case; data: the case as a dictionary; timeout: s, or None."""

    file: str
    title: str
    case: str
    data: dict
    seeds: tuple
    seed_keys: tuple
    threads: int
    ranks: int
    parallel: int | None
    timeout: float | None
    common: dict
    points: tuple
    quantities: tuple

    @property
    def name(self):
        """Of its file, without .toml."""
        return os.path.splitext(os.path.basename(self.file))[0]

    @property
    def runs(self):
        """All runs: every point with the first seed, then with the next, so that tables are complete early."""
        return [self.run(point, seed) for seed in self.seeds or (None,) for point in self.points]

    def run(self, point, seed):
        overrides = {**self.common, **point.values, **({} if seed is None else dict.fromkeys(self.seed_keys, seed))}
        label = "-".join(part for part in (point.label, "" if seed is None else f"seed_{seed}") if part)
        return Run(label or "run", point, seed, overrides, digest(self.data, overrides))

    @property
    def at_a_time(self):
        """Number of runs at a time on this machine."""
        return self.parallel or max(1, len(os.sched_getaffinity(0)) // (self.threads * self.ranks))


def read_sweep(path, extra=None, seeds=None, threads=None, parallel=None):
    """The sweep of a file.

    extra: further overrides, {"time.end": 50.0}: they replace those of [common], and points replace them. seeds,
    threads, parallel: replace those of the file. Raises StudyError with all problems of the file.
    """
    file = os.fspath(path)
    problems = []
    table = TableReader(read_toml(file, "sweep"), file, problems)
    title, case = table.text("title"), table.text("case")
    given = tuple(table.integers("seeds", default=[], at_least=0))
    seed_keys = table.texts("seed_keys", default=["director.seed"])
    its_threads, its_ranks, its_parallel = table.integer("threads", 1), table.integer("ranks", 1), _parallel(table)
    timeout = table.number("timeout", default=None, above=0)
    common = read_overrides(table.table("common"))
    points = [*grid_points(table.table("grid")), *named_points(table)]
    quantities = tuple(_quantity(one) for one in table.tables("quantity"))
    table.finish()
    seeds = given if seeds is None else tuple(seeds)
    if not points and not seeds and not problems:
        problems.append(f"{file}: nothing changes from run to run: give [grid], [point.NAME] or seeds")
    if problems:
        raise StudyError(problems)
    case = table.beside(case)
    sweep = Sweep(file, title, case, read_toml(case, "sweep's case"), seeds, tuple(seed_keys), threads or its_threads,
                  its_ranks, parallel or its_parallel, timeout, {**common, **(extra or {})}, tuple(points) or (Point("", {}),),
                  quantities)
    problems = [f"{file}: {problem}" for problem in conflicts(sweep, "seed_keys" in table, common)]
    if problems:
        raise StudyError(problems)
    return sweep


def _parallel(table):
    if table.data.get("parallel") == "auto":
        table.known.append("parallel")
        return None
    before = len(table.problems)
    count = table.integer("parallel", default=None)
    if len(table.problems) > before:
        table.problems[-1] += ', or "auto"'
    return count


def _quantity(table):
    observer, series = table.series()
    name = table.text("name", default=f"{observer}.{series}")
    start, end = table.number("from", -math.inf), table.number("until", math.inf)
    blocks = table.integer("blocks", default=None, at_least=2)
    if start >= end:
        table.refuse("until", f"must be after from = {start:g}")
    table.finish()
    return Quantity(name, observer, series, start, end, blocks)
