"""Scenes that run on host and device: the paper's, smaller, with a mean flow that carries particles out of the box."""

import json
import pathlib
import subprocess

from speed_runs import SPACING, paper_case

MEAN_FLOW = '\n[velocity]\ntype = "uniform"\nvalue = [0.5, -0.3]\n'
# How each advances, and its time step, s. A step moves a particle by at most half of a spacing.
SCENES = {
    "explicit": (["time.stepping=explicit", "time.step=2e-4"], 2e-4),
    "stabilised": (["time.stepping=stabilised", "time.step=5e-3"], 5e-3),
    "incompressible": (["physics.flow.type=incompressible", "time.step=5e-3"], 5e-3),
}


def scene(name, across, steps):
    """Settings of a run of `steps` steps in double precision, `across` particles along each edge."""
    settings, step = SCENES[name]
    edge = across * SPACING
    return [f"domain.size=[{edge!r}, {edge!r}]", f"time.end={steps * step!r}", "run.precision=double",
            "physics.activity.activity=2.0", *settings]


def command_of(place, folder, output, settings, device):
    """The command that runs a scene; its results go to folder/output."""
    folder = pathlib.Path(folder)
    (folder / "case.toml").write_text(paper_case() + MEAN_FLOW, encoding="utf-8")
    command = [str(place.mesogen), "run", "case.toml", "--quiet", "--overwrite", "--output", output]
    for setting in (*settings, f"run.device={device}"):
        command += ["--set", setting]
    return command


def has_code_for_cuda(place, plugin):
    told = json.loads(subprocess.run([str(place.mesogen), "plugin", "info", plugin, "--json"], capture_output=True,
                                     text=True, check=True).stdout)
    return told["plugins"][0]["cuda"]
