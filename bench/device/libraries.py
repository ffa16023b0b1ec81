"""Which libraries a program needs that a bare machine lacks, as the dynamic linker finds them here."""

import os
import re
import subprocess

from place import Unusable

# Of every machine: glibc, the libraries of GCC, and what belongs to the driver of the device.
OF_THE_MACHINE = re.compile(r"(linux-vdso|ld-linux.*|lib(c|m|mvec|pthread|dl|rt|resolv|util|anl|nsl|stdc\+\+|gcc_s))"
                            r"\.so(\.\d+)*|libcuda\.so.*")
LARGE = re.compile(rb"libcufft\.so(?:\.\d+)*")  # may also be opened by name while a program runs
LARGEST = 40 << 20  # bytes: what is larger leaves no room in a kit


def needed(files, folder):
    """{name: path} of all libraries that these programs and libraries need, by `ldd`. folder: where to look first.
    Raises Unusable if one is not here."""
    found = {}
    before = os.environ.get("LD_LIBRARY_PATH")
    environment = {**os.environ, "LD_LIBRARY_PATH": f"{folder}:{before}" if before else str(folder)}
    for file in files:
        text = subprocess.run(["ldd", str(file)], capture_output=True, text=True, check=True, env=environment).stdout
        for name, path in re.findall(r"^\s*(\S+) => (.+?)(?: \(0x[0-9a-f]+\))?$", text, re.MULTILINE):
            if path == "not found":
                raise Unusable(f"{file} needs {name}, which is not on this machine: install it, or add its folder to "
                               "LD_LIBRARY_PATH")
            found[name] = path
    return found


def to_pack(files, folder):
    """({name: path} of what a kit has to hold beside `folder`, names of what is too large for it)."""
    packed, left_out = {}, set()
    own = os.path.realpath(folder) + os.sep
    for name, path in needed(files, folder).items():
        path = os.path.realpath(path)
        if OF_THE_MACHINE.fullmatch(name) or path.startswith(own):
            continue
        if os.path.getsize(path) > LARGEST:
            left_out.add(name)
        else:
            packed[name] = path
    for file in files:
        left_out |= {name.decode() for name in LARGE.findall(file.read_bytes())}
    return {name: path for name, path in packed.items() if name not in left_out}, sorted(left_out)
