"""Packs a kit: all that scripts/device needs on a machine with a GPU and Python, but without Debian's packages."""

import json
import os
import pathlib
import shutil
import subprocess
import tarfile
import tempfile

from libraries import to_pack
from operations import count_operations
from place import PROJECT, Unusable

LARGEST = 40 << 20  # bytes, as tar.gz
# Of this checkout, in the same folders of the kit.
FILES = ["bench/device", "bench/device_figures.py", "bench/speed_runs.py", "bench/speed_tables.py",
         "cases/active_turbulence/paper.toml", "python/mesogen", "tests/command/small_case.py",
         "tests/command/support.py", "tests/command/test_device.py", "LICENSE"]
PROGRAMS = ["mesogen", "device_passes", "device_look"]
WRAPPER = """\
#!/bin/bash
# Runs the program of the same name in programs/ with the libraries of this kit, before those of the machine.
set -euo pipefail
here=$(readlink -f "${BASH_SOURCE[0]}")
kit=$(dirname "$(dirname "$here")")
export LD_LIBRARY_PATH=$kit/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
exec "$kit/programs/$(basename "$here")" "$@"
"""


def pack(place, target):
    """Makes the folder `target`, or the archive if its name ends with .tar.gz, and prints how large it is."""
    if place.kit is not None:
        raise Unusable("this is a kit: a kit is packed in a checkout, by `scripts/device --pack KIT`")
    place.check()
    target = target.resolve()
    archive = target.name.endswith(".tar.gz")
    name = target.name.removesuffix(".tar.gz")
    if target.exists() and (not archive or target.is_dir()):
        raise Unusable(f"{target} is there already: remove it, or name another one")
    target.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="mesogen-kit-", dir=target.parent) as work:
        kit = pathlib.Path(work) / name
        fill(place, kit)
        packed = pathlib.Path(work) / "kit.tar.gz"
        with tarfile.open(packed, "w:gz", compresslevel=6) as file:
            file.add(kit, arcname=name)
        size = packed.stat().st_size
        check_size(size, kit)
        (packed if archive else kit).rename(target)
    print(f"{target}: {size / 2**20:.1f} MiB" + ("" if archive else " as tar.gz"))


def check_size(size, kit):
    """Raises Unusable if a kit is too large, with the largest of its files."""
    if size <= LARGEST:
        return
    files = sorted((file for file in kit.rglob("*") if file.is_file()), key=lambda file: -file.stat().st_size)
    raise Unusable(f"the kit is {size / 2**20:.1f} MiB as tar.gz, and may be {LARGEST / 2**20:.0f}. Its largest "
                   "files: " +
                   ", ".join(f"{file.relative_to(kit)} ({file.stat().st_size / 2**20:.1f} MiB)" for file in files[:5]))


def fill(place, kit):
    """Puts everything into the folder `kit`."""
    operations = count_operations(place)
    with tempfile.TemporaryDirectory(prefix="mesogen-kit-") as prefix:
        for component in ([], ["--component", "device_kit"]):
            install(place, [*component, "--prefix", prefix, "--strip"])
        prefix = pathlib.Path(prefix)
        (kit / "bin").mkdir(parents=True)
        (kit / "programs").mkdir()
        for program in PROGRAMS:
            shutil.copy2(prefix / "bin" / program, kit / "programs" / program)
            wrapper = kit / "bin" / program
            wrapper.write_text(WRAPPER, encoding="utf-8")
            wrapper.chmod(0o755)
        shutil.copytree(prefix / "lib", kit / "lib", symlinks=True,
                        ignore=shutil.ignore_patterns("python", "cmake", "*.a"))
    binaries = [file for folder in ("programs", "lib") for file in (kit / folder).rglob("*")
                if file.is_file() and not file.is_symlink() and is_elf(file)]
    libraries, left_out = to_pack(binaries, kit / "lib")
    for name, path in libraries.items():
        shutil.copy2(path, kit / "lib" / name)
    for name in FILES:
        copy(PROJECT / name, kit / name)
    shutil.copy2(PROJECT / "scripts/device", kit / "device")
    (kit / "bench/device/operations.json").write_text(json.dumps(operations, indent=2) + "\n", encoding="utf-8")
    (kit / "kit.json").write_text(json.dumps({"libc": os.confstr("CS_GNU_LIBC_VERSION"), "left_out": left_out,
                                              "libraries": sorted(libraries)}, indent=2) + "\n", encoding="utf-8")
    for name in left_out:
        print(f"{name} is too large for a kit: KIT/device looks for it in the CUDA toolkit of its machine")


def install(place, how):
    done = subprocess.run(["cmake", "--install", str(place.build), *how], capture_output=True, text=True, check=False)
    if done.returncode:
        raise Unusable(f"{place.build} cannot be installed: build all of it by `MESOGEN_CUDA=on scripts/setup "
                       f"all`.\n{done.stderr.strip()}")


def copy(source, target):
    target.parent.mkdir(parents=True, exist_ok=True)
    if source.is_dir():
        shutil.copytree(source, target, ignore=shutil.ignore_patterns("__pycache__", "test_*", "operations.json"))
    else:
        shutil.copy2(source, target)


def is_elf(file):
    with open(file, "rb") as opened:
        return opened.read(4) == b"\x7fELF"
