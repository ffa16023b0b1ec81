"""kernel_report.py OBJECT COMMAND...

Runs a compiler and keeps what its assembler (ptxas -v) says of the kernels in OBJECT.kernels; prints the rest. So
test_kernels.py knows the registers of every kernel, and nobody has to read them while building."""

import pathlib
import re
import subprocess
import sys

OF_KERNELS = re.compile(r"ptxas info|^\s+\d+ bytes stack frame")


def main():
    target, command = sys.argv[1], sys.argv[2:]
    compiler = subprocess.run(command, stderr=subprocess.PIPE, text=True, check=False)
    lines = compiler.stderr.splitlines(keepends=True)
    pathlib.Path(target + ".kernels").write_text("".join(line for line in lines if OF_KERNELS.search(line)))
    sys.stderr.write("".join(line for line in lines if not OF_KERNELS.search(line)))
    return compiler.returncode


if __name__ == "__main__":
    sys.exit(main())
