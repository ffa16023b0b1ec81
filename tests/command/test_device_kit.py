"""A kit of scripts/device, packed here, holds all that it needs: it is unpacked elsewhere and run with an environment
that knows nothing of this checkout. The host plays the device."""

import glob
import json
import os
import pathlib
import re
import subprocess
import sys
import tarfile
import unittest

from support import MESOGEN, PROJECT, CommandTest

BUILD = pathlib.Path(MESOGEN).resolve().parents[1]
SCRIPT = os.path.join(PROJECT, "scripts/device")
STAGES = ["look", "passes", "memcheck", "initcheck", "tests", "agreement", "speed", "large", "roofline", "counters",
          "largest"]
LARGEST = 40 << 20
# Of every machine.
SYSTEM = re.compile(r"linux-vdso|/\S*ld-linux|statically linked|lib(c|m|mvec|pthread|dl|rt|resolv|stdc\+\+|gcc_s)\.so")


@unittest.skipUnless((BUILD / "lib/libmesogen_cuda.so").exists(), "Mesogen was built without CUDA: there is no kit")
class Kit(CommandTest):
    def bare(self, command, folder, **more):
        """Runs a command with an environment in which nothing is set."""
        environment = {"PATH": "/usr/bin:/bin", "HOME": folder, "OMP_NUM_THREADS": "1", **more}
        return subprocess.run(command, cwd=folder, env=environment, text=True, capture_output=True, timeout=300,
                              check=False)

    def pack(self, target, code=0):
        done = subprocess.run([SCRIPT, "--build", str(BUILD), "--pack", target], cwd=self.folder, text=True,
                              env=self.environment(), capture_output=True, timeout=300, check=False)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def unpacked(self):
        self.assertRegex(self.pack("kit.tar.gz"), r"kit\.tar\.gz: \d+\.\d MiB\n$")
        self.assertLessEqual(os.path.getsize(self.path("kit.tar.gz")), LARGEST)
        os.mkdir(self.path("there"))
        with tarfile.open(self.path("kit.tar.gz")) as archive:
            archive.extractall(self.path("there"))
        self.assertEqual(os.listdir(self.path("there")), ["kit"])
        return pathlib.Path(self.path("there", "kit"))

    def test_a_kit_runs_elsewhere(self):
        kit = self.unpacked()
        with self.subTest("nothing names the build folder"):
            names = [os.fsencode(BUILD), os.fsencode(PROJECT)]
            found = [str(file) for file in kit.rglob("*") if file.is_file() and
                     any(re.search(re.escape(name) + rb"[/\0:]", file.read_bytes()) for name in names)]
            self.assertEqual(found, [])
        with self.subTest("each library is of the kit or of every machine"):
            left_out = json.loads((kit / "kit.json").read_text(encoding="utf-8"))["left_out"]  # too large: of CUDA
            for file in [*(kit / "programs").iterdir(), *kit.rglob("*.so")]:
                done = self.bare(["ldd", str(file)], self.folder, LD_LIBRARY_PATH=str(kit / "lib"))
                self.assertEqual(done.returncode, 0, f"{file}: {done.stderr}")
                for line in done.stdout.splitlines():
                    name, _, path = line.strip().partition(" => ")
                    self.assertTrue(path.startswith(f"{kit}/lib/") or SYSTEM.match(name) or name in left_out,
                                    f"{file}: {line}")
        os.mkdir(self.path("elsewhere"))
        done = self.bare([str(kit / "device"), "out"], self.path("elsewhere"), MESOGEN_CUDA_ON_HOST="1")
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)  # nothing failed; some cannot run here
        self.assertIn("The host played the device: times say nothing of a GPU", done.stdout)
        out = pathlib.Path(self.path("elsewhere", "out"))
        self.assertIn((out / "summary.md").read_text(encoding="utf-8"), done.stdout)
        results = json.loads((out / "results.json").read_text(encoding="utf-8"))
        self.assertTrue(results["emulated"])
        self.assertEqual(list(dict.fromkeys(line["stage"] for line in results["lines"])), STAGES)
        for line in results["lines"]:
            self.assertIn(line["verdict"], ("PASS, emulated", "NOT RUN"), line)
            self.assertTrue(line["detail"], line)
        for name in STAGES:
            self.assertTrue((out / f"{name}.log").exists(), name)
        self.check_differences(results)
        self.check_times(results)

    def check_differences(self, results):
        lines = {line["what"]: line for line in results["lines"] if line["stage"] == "agreement"}
        for name in ("explicit", "stabilised", "incompressible"):
            differences = lines[f"{name}, host against device"]["numbers"]
            self.assertIn("velocity", differences)
            for field, value in differences.items():
                self.assertLessEqual(value, 1e-10, f"{name}: {field}")
                self.assertGreaterEqual(value, 0.0, f"{name}: {field}")
            self.assertEqual(lines[f"{name}, device twice"]["numbers"]["different"], 0)

    def check_times(self, results):
        lines = [line for line in results["lines"] if line["stage"] in ("speed", "large", "largest")]
        times = [line["numbers"]["milliseconds"] for line in lines if "milliseconds" in line["numbers"]]
        self.assertGreaterEqual(len(times), 4)
        for value in times:
            self.assertGreater(value, 0.0)
        self.assertFalse(any("goal" in line["numbers"] for line in lines))
        # What the page takes its tables from has the numbers of a device alone.
        speed = subprocess.run([sys.executable, "-B", os.path.join(PROJECT, "bench/speed.py"), "--device-results",
                                self.path("elsewhere", "out")], text=True, capture_output=True, check=False)
        self.assertEqual(speed.returncode, 1)
        self.assertIn("was made by the emulated device, whose times say nothing of a GPU", speed.stderr)

    def test_what_is_there_stays(self):
        self.write("", "kit", "mine")
        self.assertIn("kit is there already: remove it, or name another one", self.pack(self.path("kit"), code=2))
        self.assertEqual(os.listdir(self.path("kit")), ["mine"])

    def test_without_a_device(self):
        if glob.glob("/dev/nvidia[0-9]*"):
            self.skipTest("there is a CUDA device here")
        done = subprocess.run([SCRIPT, "--build", str(BUILD), "--only", "look", "--only", "passes", self.path("out")],
                              text=True, env=self.environment(), capture_output=True, timeout=100, check=False)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertRegex(done.stdout, r"\| look \| the device \| FAIL \| there is no CUDA device here \(.+\): run this "
                                      r"on a machine with an NVIDIA GPU, or let the host play the device by "
                                      r"MESOGEN_CUDA_ON_HOST=1 \|")
        self.assertRegex(done.stdout, r"\| passes \| all \| NOT RUN \| there is no CUDA device here \(.+\) \|")


if __name__ == "__main__":
    unittest.main()
