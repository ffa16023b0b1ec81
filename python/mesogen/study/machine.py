"""On what the runs ran."""

import json
import os
import subprocess

from .errors import StudyError
from .overrides import digest

DEFAULTS = ", defaults "  # in the column `version`, before their digest


def machine_text():
    """The processor, and how many cores this process may use."""
    name = "unknown processor"
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            names = [line.split(":", 1)[1].strip() for line in file if line.startswith("model name")]
        name = names[0] if names else name
    except OSError:
        pass
    count = len(os.sched_getaffinity(0))
    return f"{name}, {count} core{'s' if count != 1 else ''}"


def version_text(program):
    """What `mesogen --version` says: version, compiler, build. Raises StudyError if it cannot be started."""
    try:
        done = subprocess.run([program, "--version"], capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError) as error:
        raise StudyError(f"{program} cannot be started ({error}); give the command with --mesogen") from error
    return done.stdout.strip()


def program_text(program):
    """version_text, and a digest of all keys with their defaults: a case that leaves them out means another one where they
    differ."""
    return version_text(program) + DEFAULTS + digest(_without_words(schema(program)))


def schema(program):
    """The JSON schema of a case. Raises StudyError if the program cannot say it."""
    done = subprocess.run([program, "schema"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise StudyError(f"{program} schema failed: {done.stderr.strip()}")
    return json.loads(done.stdout)


def of_same_defaults(rows, program):
    """The rows of the ledger whose defaults are those of this program; all of them if it cannot be asked."""
    try:
        mine = program_text(program).partition(DEFAULTS)[2]
    except StudyError:
        return rows  # there is nothing to compare with, and nothing to run
    return [row for row in rows if row["version"].partition(DEFAULTS)[2] == mine]


def _without_words(schema):
    """A JSON schema without what is said about it."""
    if isinstance(schema, dict):
        return {key: _without_words(value) for key, value in schema.items()
                if key not in ("title", "description") or not isinstance(value, str)}
    return [_without_words(value) for value in schema] if isinstance(schema, list) else schema
