"""Tables of TOML files, read key by key. Missing, wrong and unknown keys are collected, each with its place."""

import difflib
import math
import os
import tomllib

from ..errors import StudyError

REQUIRED = object()


def read_toml(path, what):
    """The TOML file as a dictionary. what: its name in messages: "study", "answer". Raises StudyError."""
    try:
        with open(path, "rb") as file:
            return tomllib.load(file)
    except OSError as error:
        raise StudyError(f"{path}: the {what} cannot be read: {os.strerror(error.errno)}") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise StudyError(f"{path}: the {what} is not TOML: {error}") from error


def nearest(name, candidates):
    """For a message: '; did you mean ...?' with the nearest name, all names if none is near."""
    return near(name, candidates) or (f"; there are: {', '.join(candidates)}" if candidates else "")


def near(name, candidates):
    """For a message: '; did you mean ...?' with the nearest name, "" if none is near."""
    found = difflib.get_close_matches(name, list(candidates), n=1, cutoff=0.6)
    return f"; did you mean '{found[0]}'?" if found else ""


def key_text(key):
    """A key as TOML has it: quoted if it has a dot."""
    bare = key and all(letter.isalnum() or letter in "_-" for letter in key)
    return key if bare else f'"{key}"'


class TableReader:
    """One table, with a method for each type of value.

    data: the table; file: where it is, for messages; path: its dotted name there. A method returns the value of a key,
    or its default, and adds what is wrong to `problems`. Call finish() after the last key: it refuses the keys that
    nobody asked for.
    """

    def __init__(self, data, file, problems, path=""):
        self.data, self.file, self.problems, self.path = data, file, problems, path
        self.known = []

    def place(self, key=""):
        """Where a key, or the table itself, is, for messages: "FILE: TABLE.KEY"."""
        parts = [part for part in (self.path, key_text(key) if key else "") if part]
        return f"{self.file}: {'.'.join(parts)}" if parts else self.file

    def beside(self, name):
        """The path of a file that this file names, relative to its own folder."""
        return os.path.normpath(os.path.join(os.path.dirname(self.file), name))

    def refuse(self, key, problem):
        """Adds what is wrong with a key to `problems`."""
        self.problems.append(f"{self.place(key)}: {problem}")

    def __contains__(self, key):
        return key in self.data

    def _value(self, key, default, fits, wanted):
        self.known.append(key)
        if key not in self.data:
            if default is REQUIRED:
                self.refuse(key, f"is missing; it is {wanted}")
                return None
            return default
        value = self.data[key]
        if not fits(value):
            self.refuse(key, f"must be {wanted}")
            return None if default is REQUIRED else default
        return value

    def text(self, key, default=REQUIRED, choices=None):
        wanted = "one of: " + ", ".join(choices) if choices else "a text"
        value = self._value(key, default, lambda v: isinstance(v, str), wanted)
        if choices and isinstance(value, str) and value not in choices:
            self.refuse(key, f"'{value}' is none of: {', '.join(choices)}{near(value, choices)}")
            return None if default is REQUIRED else default
        return value

    def number(self, key, default=REQUIRED, above=-math.inf):
        wanted = "a number" + (f" above {above:g}" if above > -math.inf else "")
        return self._value(key, default, lambda v: is_number(v) and v > above, wanted)

    def integer(self, key, default=REQUIRED, at_least=1):
        return self._value(key, default, lambda v: is_integer(v) and v >= at_least,
                           f"a whole number, at least {at_least}")

    def numbers(self, key, default=REQUIRED, count=None):
        wanted = f"a list of {count} numbers" if count else "a list of one or more numbers"
        def fits(value):
            return (isinstance(value, list) and value and all(is_number(v) for v in value)
                    and count in (None, len(value)))
        return self._value(key, default, fits, wanted)

    def integers(self, key, default=REQUIRED, at_least=1):
        def fits(value):
            return (isinstance(value, list) and value and all(is_integer(v) and v >= at_least for v in value)
                    and len(set(value)) == len(value))
        return self._value(key, default, fits, f"a list of different whole numbers, each at least {at_least}")

    def texts(self, key, default=REQUIRED):
        def fits(value):
            return isinstance(value, list) and all(isinstance(v, str) for v in value) and len(set(value)) == len(value)
        return self._value(key, default, fits, "a list of different texts")

    def series(self, key="series"):
        """(observer, quantity) of a required text "OBSERVER.QUANTITY"; two empty texts if it is wrong."""
        series = self.text(key)
        if series is not None and series.count(".") != 1:
            self.refuse(key, f"'{series}' must be OBSERVER.QUANTITY, the observer as the case names it")
            series = None
        return tuple(series.split(".")) if series else ("", "")

    def table(self, key, required=False):
        """A TableReader of the table [key], of an empty one if there is none."""
        value = self._value(key, REQUIRED if required else {}, lambda v: isinstance(v, dict), f"a table [{key}]")
        return TableReader(value or {}, self.file, self.problems, f"{self.path}.{key}" if self.path else key)

    def tables(self, key):
        """A TableReader for each member of the list [[key]]; at least one must be there."""
        value = self._value(key, REQUIRED, lambda v: isinstance(v, list) and v and all(isinstance(t, dict) for t in v),
                            f"one or more tables [[{key}]]")
        return [TableReader(table, self.file, self.problems, f"{key}[{number}]")
                for number, table in enumerate(value or [], start=1)]

    def named_tables(self, key, required=True):
        """{name: TableReader} of the tables [key.NAME]; where required, at least one must be there."""
        value = self._value(key, REQUIRED if required else {}, lambda v: isinstance(v, dict) and v and
                            all(isinstance(t, dict) for t in v.values()), f"one or more tables [{key}.NAME]")
        return {name: TableReader(table, self.file, self.problems, f"{key}.{key_text(name)}")
                for name, table in (value or {}).items()}

    def finish(self):
        """Refuses all keys that were not asked for."""
        for key in self.data:
            if key not in self.known:
                self.refuse(key, f"no such key{nearest(key, self.known)}")


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def is_integer(value):
    return isinstance(value, int) and not isinstance(value, bool)
