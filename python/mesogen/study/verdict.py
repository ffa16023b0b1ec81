"""Claims and their verdicts."""

from dataclasses import dataclass

HOLDS = "holds"
DOES_NOT_HOLD = "does not hold"
NOT_RESOLVED = "not resolved"
VERDICTS = (HOLDS, DOES_NOT_HOLD, NOT_RESOLVED)


@dataclass(frozen=True)
class Claim:
    """A claim with its verdict. numbers: what decides it, as a sentence; remark: the reason, or a condition."""

    text: str
    verdict: str
    numbers: str
    remark: str = ""

    def __post_init__(self):
        if self.verdict not in VERDICTS:
            raise ValueError(f"'{self.verdict}' is no verdict; they are: {', '.join(VERDICTS)}; above(), "
                             "agrees() and decided() make one")


def all_of(verdicts):
    """The verdict on a claim with several parts: it holds if all parts do, and does not if one part does not."""
    verdicts = list(verdicts)
    if DOES_NOT_HOLD in verdicts:
        return DOES_NOT_HOLD
    return HOLDS if verdicts and all(verdict == HOLDS for verdict in verdicts) else NOT_RESOLVED
