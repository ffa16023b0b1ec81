"""test_kernels.py BUILD

What the compiler says of every kernel that Mesogen may start on a device: none has arrays or spilled registers in
local memory, which is as slow as all other memory, and sums over pairs take few registers, so that many warps run side
by side."""

import dataclasses
import pathlib
import re
import subprocess
import sys
import unittest

MOST_REGISTERS = {"f": 64, "d": 96}  # of a sum over pairs in single and in double precision
KERNEL = re.compile(
    r"Compiling entry function '(?P<name>\S+)' for '(?P<architecture>\w+)'.*?"
    r"(?P<stack>\d+) bytes stack frame, (?P<stores>\d+) bytes spill stores, (?P<loads>\d+) bytes spill loads.*?"
    r"Used (?P<registers>\d+) registers", re.DOTALL)
PAIR_SUM = re.compile(r"(?:PairLoop|DerivativeLoop)I(?P<precision>[fd])Li")


@dataclasses.dataclass
class Kernel:
    source: str
    name: str
    architecture: str
    stack: int
    spilled: int
    registers: int

    def __str__(self):
        return (f"{self.source} for {self.architecture}: {self.registers} registers, {self.stack} bytes of stack, "
                f"{self.spilled} bytes spilled: {plain(self.name)}")


def plain(mangled):
    """The name that a kernel has in the source, shortened."""
    name = subprocess.run(["c++filt", mangled], capture_output=True, text=True, check=True).stdout.strip()
    return re.sub(r"mesogen::|exec::|sph::", "", name)[:300]


def kernels(report, source):
    return [Kernel(source, found["name"], found["architecture"], int(found["stack"]),
                   int(found["stores"]) + int(found["loads"]), int(found["registers"]))
            for found in KERNEL.finditer(report)]


class Kernels(unittest.TestCase):
    build = None
    longMessage = False

    @classmethod
    def setUpClass(cls):
        cls.all = [kernel for path in sorted(cls.build.rglob("*.cu.o.kernels")) if path.with_suffix("").exists()
                   for kernel in kernels(path.read_text(), path.name.removesuffix(".o.kernels"))]

    def expect_none(self, bad, what):
        self.assertEqual(bad, [], f"{len(bad)} of {len(self.all)} kernels {what}:\n" + "\n".join(map(str, bad[:20])))

    def test_reports_are_there(self):
        self.assertGreater(len(self.all), 200)
        self.assertTrue(any(PAIR_SUM.search(kernel.name) for kernel in self.all))

    def test_nothing_lies_in_local_memory(self):
        # CUB's own kernels aside: how they sort is theirs.
        ours = [kernel for kernel in self.all if "3cub" not in kernel.name]
        self.expect_none([kernel for kernel in ours if kernel.stack + kernel.spilled > 0], "use local memory")

    def test_sums_over_pairs_take_few_registers(self):
        def most(kernel):
            found = PAIR_SUM.search(kernel.name)
            return MOST_REGISTERS[found["precision"]] if found else 255

        self.expect_none([kernel for kernel in self.all if kernel.registers > most(kernel)], "take too many registers")


class Reading(unittest.TestCase):
    def test_a_report(self):
        [kernel] = kernels(
            "ptxas info    : Compiling entry function '_Z3sumi' for 'sm_90'\n"
            "ptxas info    : Function properties for _Z3sumi\n"
            "    16 bytes stack frame, 4 bytes spill stores, 8 bytes spill loads\n"
            "ptxas info    : Used 47 registers, used 0 barriers, 16 bytes cumulative stack size\n", "sum.cu")
        self.assertEqual(str(kernel), "sum.cu for sm_90: 47 registers, 16 bytes of stack, 12 bytes spilled: sum(int)")


if __name__ == "__main__":
    Kernels.build = pathlib.Path(sys.argv.pop(1))
    unittest.main()
