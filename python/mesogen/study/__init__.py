"""Studies that test claims against results: `mesogen study FOLDER`.

A study is a folder with study.toml, the sweeps whose runs it needs, and one Python file per section of its report. A
section draws figures from the runs, and decides for each claim whether it holds. The format: docs/studies.md.
"""

from .estimate import Estimate, above, agrees, decided, exponent, over_seeds, ratio
from .verdict import DOES_NOT_HOLD, HOLDS, NOT_RESOLVED, Claim

__all__ = ["DOES_NOT_HOLD", "HOLDS", "NOT_RESOLVED", "Claim", "Estimate", "above", "agrees", "decided",
           "exponent", "over_seeds", "ratio"]
