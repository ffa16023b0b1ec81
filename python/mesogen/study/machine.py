"""On what the runs ran."""

import os
import subprocess

from .errors import StudyError


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
