"""The errors of this package. Each text says what is wrong, where, and what to do."""


class MesogenError(Exception):
    """Something asked of a run's results cannot be given."""


class NoResults(MesogenError):
    """The folder or file holds no readable results."""


class NoSuchName(MesogenError, LookupError):
    """No field, observer, quantity or frame of that name; the text lists those that exist."""


class StudyError(MesogenError):
    """A study, sweep, scene or answer that cannot be used.

    problems: one text for each problem; the message of the error has one problem per line.
    """

    def __init__(self, problems):
        self.problems = [problems] if isinstance(problems, str) else list(problems)
        super().__init__("\n".join(self.problems))


class Refused(StudyError):
    """A case that the command `mesogen` refuses, in its own words."""


class Interrupted(Exception):
    """The user stopped the command; finished runs are kept."""


def missing(kind, name, existing, where):
    """NoSuchName for `name`, listing the names that exist.

    kind: "field", "observer", ...; existing: the names there; where: the file or group that was searched.
    """
    existing = sorted(existing)
    there = f"there are: {', '.join(existing)}" if existing else f"it holds no {kind} at all"
    return NoSuchName(f"no {kind} '{name}' in {where}; {there}")
