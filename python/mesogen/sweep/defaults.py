"""The defaults of mesogen that a run depends on: where one of them changes, a run of the same case is another.

Those of plugins that a case does not name are left out, so that a new plugin leaves the runs of a sweep as they are.
"""

from ..study.machine import DEFAULTS, schema, version_text
from ..study.overrides import digest

PLUGINS = ("physics", "observer", "kernel", "boundary")  # sections of the schema with a definition for each plugin


class Program:
    """A mesogen, and what it says of itself. Raises StudyError if it cannot be asked."""

    def __init__(self, command):
        self.command = command
        self.version = version_text(command)
        self._defaults = list(_defaults(schema(command), ()))

    def version_for(self, *settings):
        """Its version and a digest of the defaults that a case with these settings (nested dictionaries) depends on, as
        the column `version` of runs.csv holds them."""
        words = set(_words(settings))
        return self.version + DEFAULTS + digest([(path, value) for path, value in self._defaults if _used(path, words)])


def _used(path, words):
    kind, _, name = path[0].partition(".")
    return kind not in PLUGINS or not name or name in words


def _defaults(node, path):
    """(path, default) of every key of a JSON schema that has one."""
    if isinstance(node, list):
        for one in node:
            yield from _defaults(one, path)
    elif isinstance(node, dict):
        if "default" in node:
            yield path, node["default"]
        for key, value in node.items():
            if key in ("properties", "patternProperties", "definitions"):
                for name, one in value.items():
                    yield from _defaults(one, (*path, name))
            elif key not in ("default", "enum", "const"):
                yield from _defaults(value, path)


def _words(value):
    """All texts in nested dictionaries and lists."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        yield from _words(list(value.values()))
    elif isinstance(value, (list, tuple)):
        for one in value:
            yield from _words(one)
