"""Runs on a CUDA device: that they agree with those on the host, and what is said where there is none.

Where there is no device the code for it runs on the host (MESOGEN_CUDA_ON_HOST = 1): the same libraries, loops and
order of work, with memory of its own, in which what is out of date is no number; but for the start of kernels."""

import glob
import json
import os
import pathlib
import shutil
import signal
import subprocess
import time
import unittest

import h5py
import numpy
from support import BROKEN_PLUGINS, CASE, MESOGEN, CommandTest

LIBRARY = pathlib.Path(MESOGEN).parent.parent / "lib" / "libmesogen_cuda.so"
BUILT = LIBRARY.exists()
# DEVICE_IS_HERE: 1 or 0, from who knows it. scripts/device does.
DEVICE = BUILT and os.environ.get("DEVICE_IS_HERE", str(int(bool(glob.glob("/dev/nvidia[0-9]*"))))) == "1"
ON_CUDA = {} if DEVICE else {"MESOGEN_CUDA_ON_HOST": "1"}
CUDA = ["--set", "run.device=cuda"]
# Particles are sorted anew a few times, and leave the box.
MOVING = CASE.replace("end = 0.1", "end = 3.0").replace("interval = 0.05", "interval = 1.0").replace(
    'activity = 0.05', 'activity = 2.0').replace("[physics.flow]", '[velocity]\ntype = "uniform"\nvalue = [0.5, -0.3]\n'
                                                 "[physics.flow]")
ON_A_MESH = MOVING.replace('"wcsph"', '"incompressible"')
# A plugin without code for CUDA, where it is at hand: a kit of scripts/device has none.
STRANGER = CASE + '[physics.stranger]\ntype = "misbehaving"\nmisdeed = "none"\n'
STRANGERS_FOLDER = ["--plugin-path", os.path.join(BROKEN_PLUGINS, "misbehaving")] if BROKEN_PLUGINS else []
needs_the_stranger = unittest.skipUnless(BROKEN_PLUGINS, "there is no plugin without code for CUDA at hand")
SCENES = {
    "copies": MOVING,
    "wrapped": MOVING.replace("periodic_ghosts", "periodic_wrap"),
    "walls": CASE.replace('boundary = "periodic_ghosts"', 'boundary = { type = "walls" }'),
    "a solid": CASE.replace("end = 0.1", "end = 0.5") +
               '[solids.pillar]\nshape = "disc"\ncentre = [0.8, 0.8]\nradius = 0.3\nfluid = "outside"\n'
               'angular_velocity = 0.5\n',
    "single precision": CASE.replace('"double"', '"single"'),
    "Eulerian": CASE.replace("viscosity = 0.5", 'viscosity = 0.5\nmotion = "eulerian"'),
    "pairs": CASE.replace("activity = 0.05", 'activity = 0.05\nform = "conservative"') +
             '[physics.elastic]\ntype = "elastic_stress"\n',
    "mesh": ON_A_MESH,
    "mesh, wrapped, in single precision":
        ON_A_MESH.replace("periodic_ghosts", "periodic_wrap").replace('"double"', '"single"').replace("end = 3.0",
                                                                                                      "end = 1.0"),
    "mesh, beside pair sums": ON_A_MESH.replace("activity = 2.0", 'activity = 2.0\nform = "conservative"'),
    "mesh, without inertia": ON_A_MESH.replace("density = 1.0", "density = 1.0\ninertia = false") +
                             '[physics.substrate]\ntype = "friction"\ncoefficient = 0.3\n',
    **({"a plugin on the host": STRANGER} if BROKEN_PLUGINS else {}),
    "half steps": CASE.replace("end = 0.1", 'end = 0.1\nscheme = "half_steps"'),
}


@unittest.skipUnless(BUILT, "Mesogen was built without CUDA")
class OnCuda(CommandTest):
    def on_cuda(self, *arguments, code=0):
        return self.mesogen(*arguments, code=code, **ON_CUDA)

    def fields(self, folder):
        with h5py.File(self.path(folder, "results.h5"), "r") as file:
            fluid = file["particles/fluid"]
            return {name: numpy.asarray(fluid[name]["value"]) for name in ("position", "velocity", "order_tensor")}

    def field(self, folder, name):
        with h5py.File(self.path(folder, "results.h5"), "r") as file:
            return numpy.asarray(file[f"particles/fluid/{name}/value"])

    @unittest.skipIf(DEVICE, "the host plays no device where there is one")
    def test_the_host_can_play_the_device_in_every_run(self):
        case = self.write_case(CASE)
        _, err = self.mesogen("run", case, "--set", "run.device=cpu", MESOGEN_CUDA_ON_HOST="everywhere")
        self.assertIn("computing on the host, for a test", err)

    def test_agrees_with_the_host(self):
        for name, text in SCENES.items():
            with self.subTest(name):
                case = self.write_case(text)
                self.mesogen("run", case, "--output", "host", "--overwrite", *STRANGERS_FOLDER)
                _, err = self.on_cuda("run", case, "--output", "cuda", "--overwrite", *CUDA, *STRANGERS_FOLDER)
                self.assertIn("computing on", err)
                host, cuda = self.fields("host"), self.fields("cuda")
                tolerance = 1e-3 if "single" in name else 1e-8
                for field, values in host.items():
                    self.assertTrue(numpy.isfinite(values).all())
                    largest = numpy.abs(values).max()
                    self.assertLess(numpy.abs(cuda[field] - values).max(), tolerance * largest, field)
                    self.assertGreater(numpy.ptp(values[-1]), 0.0, field)

    @needs_the_stranger
    def test_tells_who_stays_on_the_host(self):
        _, err = self.on_cuda("run", self.write_case(STRANGER), *CUDA, *STRANGERS_FOLDER)
        self.assertIn("physics.stranger computes on the host, since 'misbehaving' has no code for CUDA", err)
        self.assertNotIn("physics.nematic computes on the host", err)

    def test_auto_takes_the_device_where_all_have_code(self):
        auto = ["--set", "run.device=auto", "--overwrite", "--output", "out"]
        _, err = self.on_cuda("run", self.write_case(), *auto)
        self.assertIn("computing on", err)

    @needs_the_stranger
    def test_auto_takes_the_host_where_one_has_none(self):
        auto = ["--set", "run.device=auto", "--overwrite", "--output", "out"]
        _, err = self.on_cuda("run", self.write_case(STRANGER), *auto, *STRANGERS_FOLDER)
        self.assertIn("computing on the host: 'misbehaving' has no code for CUDA\n", err)

    def test_a_mesh_has_the_same_bits_in_every_run(self):
        # Of what readers ask for too.
        shown = ["velocity", "order_tensor", "pressure", "vorticity", "stream_function"]
        case = self.write_case(ON_A_MESH.replace("[output]", f"[output]\nfields = {json.dumps(shown)}") +
                               '[physics.shown]\ntype = "flow_fields"\n')
        self.mesogen("run", case, "--output", "host")
        for folder in ("one", "two"):
            self.on_cuda("run", case, "--output", folder, *CUDA)
        for field in shown:
            host, one, two = (self.field(folder, field) for folder in ("host", "one", "two"))
            self.assertTrue((one == two).all(), field)
            self.assertLess(numpy.abs(one - host).max(), 1e-8 * numpy.abs(host).max(), field)

    def test_resumes_to_the_same_bits(self):
        for scene in (MOVING, ON_A_MESH):
            with self.subTest(scene.count("incompressible")):
                self.resumes_to_the_same_bits(scene)

    def resumes_to_the_same_bits(self, scene):
        case = self.write_case(scene.replace("end = 3.0", "end = 15.0"))
        self.on_cuda("run", case, "--output", "whole", "--overwrite", *CUDA)
        whole = self.fields("whole")
        shutil.rmtree(self.path("parts"), ignore_errors=True)
        process = subprocess.Popen([MESOGEN, "run", case, "--output", "parts", *CUDA], cwd=self.folder,
                                   env=self.environment(**ON_CUDA), stderr=subprocess.DEVNULL)
        self.addCleanup(process.kill)
        while not os.path.exists(self.path("parts", "results.h5")):
            time.sleep(0.01)
        time.sleep(0.1)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=60), 130)
        _, err = self.on_cuda("resume", "parts")
        self.assertIn("resuming from", err)
        self.assertIn("computing on", err)
        for field, values in self.fields("parts").items():
            self.assertTrue((values == whole[field]).all(), field)

    def test_contract_of_plugins(self):
        for plugin in ("wcsph", "incompressible", "flow_fields", "beris_edwards", "active_stress", "friction",
                       "body_force"):
            out, _ = self.on_cuda("plugin", "check", plugin)
            self.assertIn("  ok      CUDA agrees with the CPU\n", out)

    def test_info_tells_who_has_code(self):
        stranger = [("misbehaving", False)] if BROKEN_PLUGINS else []
        for plugin, cuda in (("wcsph", True), ("incompressible", True), *stranger):
            out, _ = self.mesogen("plugin", "info", plugin, *STRANGERS_FOLDER)
            self.assertEqual("has code for CUDA too" in out, cuda)
            out, _ = self.mesogen("plugin", "info", plugin, "--json", *STRANGERS_FOLDER)
            self.assertEqual(json.loads(out)["plugins"][0]["cuda"], cuda)

    def test_observers_see_the_newest_values(self):
        observers = "".join(f'[observers.{name}]\ntype = "{name}"\nevery = 1\n'
                            for name in ("pathlines", "flow_statistics", "mixing"))
        case = self.write_case(MOVING + '[colour]\ntype = "quarter"\n' + observers)
        self.mesogen("run", case, "--output", "host")
        self.on_cuda("run", case, "--output", "cuda", *CUDA)
        with h5py.File(self.path("host", "results.h5")) as host, h5py.File(self.path("cuda", "results.h5")) as cuda:
            for name in ("pathlines/path", "flow_statistics/v_rms", "mixing/mixing_index"):
                values = numpy.asarray(host[f"observables/{name}/value"])
                self.assertGreater(len(values), 100)
                numpy.testing.assert_allclose(cuda[f"observables/{name}/value"], values, rtol=1e-6, atol=1e-8)

    @unittest.skipIf(DEVICE, "there is a CUDA device here")
    def test_too_little_memory(self):
        _, err = self.mesogen("run", self.write_case(), *CUDA, code=1, MESOGEN_CUDA_ON_HOST="1",
                              MESOGEN_CUDA_ON_HOST_BYTES="20000")
        self.assertRegex(err, r"the emulated device has too little memory: an array needs \S+ MB, and of its 0\.02 MB only "
                              r"\S+ MB are free, of which a tenth is left alone \(this run holds \S+ MB there\)\. Take "
                              r"fewer particles \(a larger particles\.spacing\), run\.precision = \"single\", or "
                              r"run\.device = \"cpu\"")

    def test_replay_needs_no_device(self):
        self.on_cuda("run", self.write_case(), "--output", "out", *CUDA)
        self.mesogen("replay", "out", "--output", "again.h5")
        self.assertTrue(os.path.exists(self.path("again.h5")))

    @unittest.skipIf(DEVICE, "there is a CUDA device here")
    def test_no_device(self):
        _, err = self.mesogen("run", self.write_case(), *CUDA, code=2)
        self.assertRegex(err, r"run\.device: there is no CUDA device here \(.+\); take \"cpu\", or \"auto\" for CUDA "
                              r"where that can be")
        self.assertFalse(os.path.exists(self.path("output")))
        _, err = self.mesogen("run", self.write_case(), "--set", "run.device=auto")
        self.assertRegex(err, r"computing on the host: there is no CUDA device here \(.+\)\n")


class WithoutCuda(CommandTest):
    @unittest.skipIf(BUILT, "Mesogen was built with CUDA")
    def test_not_built(self):
        _, err = self.mesogen("run", self.write_case(), *CUDA, code=2)
        self.assertIn('run.device: this Mesogen was built without CUDA: build it by `MESOGEN_CUDA=on scripts/setup`, '
                      'which needs nvcc (12 or later); take "cpu", or "auto" for CUDA where that can be', err)

    def test_another_word(self):
        _, err = self.mesogen("run", self.write_case(), "--set", "run.device=gpu", code=2)
        self.assertIn('run.device: must be one of: cpu, cuda, auto, but is "gpu"', err)


if __name__ == "__main__":
    unittest.main()
