"""What is wrong with a study; every message says where and how to mend it."""

from ..errors import MesogenError


class StudyError(MesogenError):
    """A study, scene or answer that cannot be used. Several problems stand in lines of their own."""

    def __init__(self, problems):
        self.problems = [problems] if isinstance(problems, str) else list(problems)
        super().__init__("\n".join(self.problems))


class Refused(StudyError):
    """What mesogen itself does not take, with its words."""


class Interrupted(Exception):
    """The user stopped the study; what was done is kept."""
