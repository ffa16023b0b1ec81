"""The mesogen and the machine that did a run: its version and defaults, the processor, the date.

A case that leaves a key out means another case where the default of that key differs. So the column `version` of
runs.csv holds a digest of the defaults too, and a run counts only while they are the same.
"""

import datetime
import json
import os
import subprocess

from ..errors import StudyError
from .overrides import digest

DEFAULTS = ", defaults "  # in the column `version`, before the digest of the defaults
PLUGINS = ("physics", "observer", "kernel", "boundary", "initial")  # sections of the schema with a definition for each plugin


class Program:
    """A command `mesogen` with its version and defaults. Raises StudyError if the command cannot be asked for them."""

    def __init__(self, command):
        self.command = command
        self.version = version_text(command)
        self._defaults = list(_defaults(_schema(command), ()))

    def version_for(self, *settings):
        """The text of the column `version`: the version, and a digest of defaults.

        settings: a case and its overrides, as nested dictionaries. Defaults of plugins that they do not name are left
        out, so that a new plugin does not make runs count no more. Without settings: all defaults.
        """
        words = set(_words(settings))
        return self.version + DEFAULTS + digest([(path, value) for path, value in self._defaults
                                                 if not settings or _used(path, words)])


def version_text(command):
    """What `mesogen --version` prints: version, compiler, build. Raises StudyError if it cannot be started."""
    try:
        done = subprocess.run([command, "--version"], capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError) as error:
        raise StudyError(f"{command} cannot be started ({error}); give the command with --mesogen") from error
    return done.stdout.strip()


def machine_text():
    """The processor, and how many of its cores this process may use."""
    name = "unknown processor"
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            names = [line.split(":", 1)[1].strip() for line in file if line.startswith("model name")]
        name = names[0] if names else name
    except OSError:
        pass
    count = len(os.sched_getaffinity(0))
    return f"{name}, {count} core{'s' if count != 1 else ''}"


def stamp(version):
    """The columns of runs.csv that tell when, where and with which version a run was done."""
    return {"date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ"),
            "machine": machine_text(), "version": version}


def split_version(version):
    """The column `version` as (version, digest of the defaults)."""
    version, _, defaults = version.partition(DEFAULTS)
    return version, defaults


def of_same_defaults(rows, command):
    """The rows of runs.csv that were done with the defaults of this command; all rows if it cannot be asked."""
    try:
        mine = split_version(Program(command).version_for())[1]
    except StudyError:
        return rows  # tables of finished runs need no mesogen
    return [row for row in rows if split_version(row["version"])[1] == mine]


def _schema(command):
    """The JSON schema of a case."""
    done = subprocess.run([command, "schema"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise StudyError(f"{command} schema failed: {done.stderr.strip()}")
    return json.loads(done.stdout)


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
    """All texts and keys in nested dictionaries and lists: an initial condition is named by a key."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        yield from value
        yield from _words(list(value.values()))
    elif isinstance(value, (list, tuple)):
        for one in value:
            yield from _words(one)
