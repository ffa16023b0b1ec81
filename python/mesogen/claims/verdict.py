"""What a study says of a claim."""

from dataclasses import dataclass

HOLDS = "holds"
DOES_NOT_HOLD = "does not hold"
NOT_RESOLVED = "not resolved"
VERDICTS = (HOLDS, DOES_NOT_HOLD, NOT_RESOLVED)


@dataclass(frozen=True)
class Claim:
    """A claim with its verdict. `numbers`: the figures that decide it, as a sentence; `remark`: why, or on what terms."""

    text: str
    verdict: str
    numbers: str
    remark: str = ""

    def __post_init__(self):
        if self.verdict not in VERDICTS:
            raise ValueError(f"'{self.verdict}' is no verdict; they are: {', '.join(VERDICTS)}; above(), "
                             "agrees() and decided() make one")


def all_of(verdicts):
    """Of a claim with several parts: it holds if all do, does not if one does not."""
    verdicts = list(verdicts)
    if DOES_NOT_HOLD in verdicts:
        return DOES_NOT_HOLD
    return HOLDS if verdicts and all(verdict == HOLDS for verdict in verdicts) else NOT_RESOLVED
