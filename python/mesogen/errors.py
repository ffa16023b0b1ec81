"""The errors of this package. Their texts say what to do next."""


class MesogenError(Exception):
    """Something asked of a run's results cannot be given."""


class NoResults(MesogenError):
    """The folder or file holds no readable results."""


class NoSuchName(MesogenError, LookupError):
    """No field, observer, quantity or frame of that name; the text lists those that exist."""


def missing(kind, name, existing, where):
    """NoSuchName for `name`, listing the names that exist.

    kind: "field", "observer", ...; existing: the names there; where: the file or group that was searched.
    """
    existing = sorted(existing)
    there = f"there are: {', '.join(existing)}" if existing else f"it holds no {kind} at all"
    return NoSuchName(f"no {kind} '{name}' in {where}; {there}")
