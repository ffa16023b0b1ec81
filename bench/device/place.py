"""Where the programs are that scripts/device runs: in a build folder of this checkout, or in a kit.

A kit has folders of a checkout (bench, cases, python, tests) beside the programs and libraries, and a file kit.json.
"""

import glob
import json
import os
import pathlib
import shutil
import subprocess

PROJECT = pathlib.Path(__file__).resolve().parents[2]
CUDA_FOLDERS = ("lib64", "targets/x86_64-linux/lib", "lib")
EMULATED = os.environ.get("MESOGEN_CUDA_ON_HOST") == "1"


def scratch(out, name="runs"):
    """An empty folder for the runs of a stage; it is removed when the stage has ended."""
    folder = out / "scratch" / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    return folder


class Unusable(Exception):
    """scripts/device cannot begin; the text says why and what would mend it."""


class Place:
    """The programs of a build folder, or those of the kit that this file is part of."""

    def __init__(self, build):
        self.kit = json.loads((PROJECT / "kit.json").read_text(encoding="utf-8")) \
            if (PROJECT / "kit.json").exists() else None
        self.build = PROJECT if self.kit is not None else pathlib.Path(build).resolve()
        self.mesogen = self.build / "bin/mesogen"

    def program(self, name):
        return self.build / "bin" / name

    def watched(self, name):
        """(program, environment) for a tool that starts the program itself, which in a kit is behind a script."""
        if self.kit is None:
            return self.program(name), {}
        folders = [str(self.build / "lib"), os.environ.get("LD_LIBRARY_PATH")]
        return self.build / "programs" / name, {"LD_LIBRARY_PATH": ":".join(folder for folder in folders if folder)}

    def check(self):
        """Raises Unusable if there is no Mesogen with code for CUDA, or if it does not start here."""
        if not self.mesogen.exists():
            raise Unusable(f"there is no {self.mesogen}: build it by `MESOGEN_CUDA=on scripts/setup all`, or name "
                           "another build folder by --build")
        library = self.build / "lib/libmesogen_cuda.so"
        if not library.exists():
            raise Unusable(f"{self.build} has no code for CUDA ({library} is missing): build it by `MESOGEN_CUDA=on "
                           "scripts/setup all`, which needs nvcc (12 or later)")
        done = subprocess.run([str(self.mesogen), "--version"], capture_output=True, text=True, check=False)
        if done.returncode:
            raise Unusable(f"{self.mesogen} does not start here:\n{(done.stderr or done.stdout).strip()}" +
                           (f"\nThe kit holds neither glibc nor libstdc++. It was packed with {self.kit['libc']}, and "
                            "needs a machine with this one or a later one." if self.kit else ""))
        return done.stdout.strip()


def cuda_folders(below):
    """Folders of the CUDA toolkits of this machine: `below` is a folder in each of them, such as "bin"."""
    roots = [os.environ.get(name) for name in ("CUDA_HOME", "CUDA_PATH")] + sorted(glob.glob("/usr/local/cuda*"))
    return [folder for folder in (pathlib.Path(root) / below for root in roots if root) if folder.is_dir()]


def find_tool(name):
    """The path of a tool of the CUDA toolkit, such as "ncu"; None if it is not on this machine."""
    found = shutil.which(name)
    if found:
        return found
    for folder in cuda_folders("bin"):
        if os.access(folder / name, os.X_OK):
            return str(folder / name)
    return None


def find_library(name):
    """The folder that holds a library which the kit has no room for: "" where the dynamic linker finds it by itself,
    None where it is not on this machine."""
    listed = subprocess.run(["/sbin/ldconfig", "-p"], capture_output=True, text=True, check=False).stdout \
        if os.path.exists("/sbin/ldconfig") else ""
    if f"\t{name} " in listed:
        return ""
    searched = [pathlib.Path(part) for part in os.environ.get("LD_LIBRARY_PATH", "").split(":") if part]
    for below in CUDA_FOLDERS:
        searched += cuda_folders(below)
    return next((str(folder) for folder in searched if (folder / name).exists()), None)


def add_libraries_of_this_machine(kit):
    """Appends to LD_LIBRARY_PATH the folders of libraries that the kit has no room for. Returns the names of those that
    are not on this machine."""
    missing = []
    for name in (kit or {}).get("left_out", []):
        folder = find_library(name)
        if folder is None:
            missing.append(name)
        elif folder:
            before = os.environ.get("LD_LIBRARY_PATH", "")
            if folder not in before.split(":"):
                os.environ["LD_LIBRARY_PATH"] = f"{before}:{folder}" if before else folder
    return missing
