"""A study of kind "accuracy" as a TOML file:

    title = "Taylor-Green vortices"
    kind = "accuracy"
    scene = "../cases/accuracy/taylor_green"    # relative to this file
    resolutions = [25, 50, 100]                 # particles across
    repeats = 3                                 # of each run; times are medians over them
    threads = 1
    timeout = 600                               # s of wall time, optional: a run that takes longer has failed
    seeds = [1, 2, 3]                           # optional: each run once per seed, the key particles.seed
    variants_from = ["variants/flow.toml"]      # optional: files of variants, see parts.py
    [common]                                    # optional: changed in all runs
    "time.end" = 0.4
    [variant.default]
    [variant.wendland_c4]
    note = "smoother kernel"                    # optional, for the table
    resolutions = [25, 50]                      # optional: instead of the study's
    "kernel.type" = "wendland_c4"               # keys of the case, dotted and quoted
"""

from dataclasses import dataclass

from ..errors import StudyError
from ..runs.overrides import digest, read_overrides
from ..runs.table_reader import TableReader
from .parts import Study, Variant, read_common


@dataclass(frozen=True)
class Job:
    """One run. Jobs with the same key differ only in `repeat`, and so in their times only."""

    key: str
    variant: str
    resolution: int
    seed: int | None
    repeat: int
    overrides: dict

    @property
    def name(self):
        return f"{self.variant} {self.resolution}" + ("" if self.seed is None else f" seed {self.seed}")


@dataclass(frozen=True)
class AccuracyStudy(Study):
    """An accuracy study. repeats: of each run; seeds: empty without any."""

    repeats: int
    seeds: tuple

    def jobs(self):
        """All runs in their order: every point once, coarse ones first, then all again. So a machine that is slow for a
        while slows all variants alike."""
        return [
            self.job(variant, resolution, seed, repeat)
            for repeat in range(1, self.repeats + 1)
            for resolution in sorted({n for variant in self.variants for n in variant.resolutions})
            for seed in self.seeds or (None,)
            for variant in self.variants
            if resolution in variant.resolutions
        ]

    def job(self, variant, resolution, seed=None, repeat=1):
        """The Job of a variant at a resolution."""
        overrides = {**self.common, **variant.overrides, "particles.spacing": self.scene.answer.across / resolution}
        if seed is not None:
            overrides["particles.seed"] = seed
        key = digest(self.scene.data, self.scene.answer.data, overrides, self.threads)
        return Job(key, variant.name, resolution, seed, repeat, overrides)


def read_accuracy_study(file, data):
    """The study. data: of the file. Raises StudyError with all problems."""
    problems = []
    table = TableReader(data, file, problems)
    resolutions = tuple(table.integers("resolutions", at_least=2) or ())
    common = read_common(table, True, lambda name, one: _variant(name, one, resolutions))
    repeats, seeds = table.integer("repeats", 1), tuple(table.integers("seeds", default=[], at_least=0))
    table.finish()
    if problems:
        raise StudyError(problems)
    return AccuracyStudy(**common, repeats=repeats, seeds=seeds)


def _variant(name, table, resolutions):
    reserved = ("note", "resolutions")
    overrides = read_overrides(table, reserved)
    if "particles.spacing" in overrides:
        table.refuse("particles.spacing", "is chosen by the resolutions; leave it out")
    note = table.text("note", "")
    own = table.integers("resolutions", default=list(resolutions), at_least=2)
    return Variant(name, overrides, note, tuple(sorted(own)))
