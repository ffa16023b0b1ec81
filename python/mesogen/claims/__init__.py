"""Studies that set results beside claims: `mesogen study FOLDER`.

A study is a folder: `study.toml`, the sweeps whose runs it needs, and a Python file for each section of its report, which
draws figures from the runs and says of each claim whether it holds. docs/studies.md tells the format.
"""

from .estimate import Estimate, above, agrees, decided, exponent, over_seeds, ratio
from .verdict import DOES_NOT_HOLD, HOLDS, NOT_RESOLVED, Claim

__all__ = ["DOES_NOT_HOLD", "HOLDS", "NOT_RESOLVED", "Claim", "Estimate", "above", "agrees", "decided",
           "exponent", "over_seeds", "ratio"]
