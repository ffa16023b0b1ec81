"""relaxation.py MESOGEN [N]: N random starts (by default 20) of a passive nematic whose elasticity acts on the flow.

Free energy, kinetic energy and that of compression together may never rise, from any earlier sample to a later one, by
more than 1e-4 of what has been dissipated by then. Both flows, periodic boxes, channels and closed boxes, cores of 2 to
3 spacings; starts are random waves or noise of 0.3 rad from particle to particle. At some walls they have the director
that is held there; at others (PLANAR) it jumps.
"""

import os
import random
import subprocess
import sys
import tempfile

import h5py
import numpy

MOST = 1e-4  # of the dissipated energy
SCENES = [("wcsph", "periodic"), ("incompressible", "periodic"), ("wcsph", "closed"), ("wcsph", "channel")]
FREE, ALONG, ACROSS = 'anchoring = "none"', 'anchoring = "angle"', 'anchoring = "homeotropic"'
PLANAR = 'anchoring = "planar"'
ANGLES = {ACROSS: 90.0, PLANAR: numpy.degrees(0.6)}
AXES = {"closed": '"x", "y"', "channel": '"y"'}
ANCHORED = {"closed": [ALONG, FREE, PLANAR], "channel": [FREE, PLANAR, ACROSS], "periodic": [""]}
CASE = """\
[domain]
size = [1.0, 1.0]
boundary = {boundary}
[particles]
spacing = {spacing:.17g}
[kernel]
type = "quintic"
[director]
angle = {angle}
{director}
[physics.flow]
type = "{flow}"
density = 1.0
viscosity = {viscosity}
[physics.nematic]
type = "beris_edwards"
rotational_diffusivity = {gamma}
flow_alignment = {alignment}
elastic_constant = {elastic:.17g}
bulk = {{ A = -1.0, C = 0.5 }}
[physics.elastic]
type = "elastic_stress"
[time]
end = 2.0
[observers.flow]
type = "flow_statistics"
interval = 0.02
[observers.order]
type = "nematic_statistics"
interval = 0.02
[run]
precision = "double"
"""


def waves(chance, box, anchoring):
    """Rows of random phases where the director is free, else pairs of them that add up to zero at the walls."""
    rows = []
    for x, y in ([1, 1], [2, 1], [1, 2]) if anchoring in (ALONG, ACROSS) else ([1, 0], [0, 1], [1, 1], [2, -1]):
        amplitude = chance.uniform(0.2, 0.8)
        phase = 0.0 if box == "closed" else chance.uniform(0.0, 6.28)
        if anchoring in (ALONG, ACROSS):  # cos(a + b) - cos(a - b) = -2 sin a sin b
            rows += [[x, y, amplitude / 2, phase], [x, -y, -amplitude / 2, phase]]
        else:
            rows.append([x, y, amplitude, chance.uniform(0.0, 6.28)])
    return rows


def start(seed):
    """A case, and what it is in words."""
    chance = random.Random(seed)
    flow, box = SCENES[seed % len(SCENES)]
    across = chance.choice([16, 20, 24])
    core = chance.choice([2.0, 2.5, 3.0])
    noise = seed // len(SCENES) % 2 == 1
    anchoring = ANCHORED[box][seed // len(SCENES) % len(ANCHORED[box])]
    alignment = chance.choice([0.3, 0.7, 1.0])
    text = CASE.format(
        flow=flow, spacing=1.0 / across, elastic=(core / across) ** 2, alignment=alignment,
        boundary=f'{{ type = "walls", axes = [{AXES[box]}], {anchoring} }}' if box in AXES else '"periodic_wrap"',
        angle=ANGLES.get(anchoring, 0.0),
        director=f'type = "perturbed"\namplitude = 0.3\nseed = {seed + 1}' if noise else
        f'type = "modes"\nmodes = {waves(chance, box, anchoring)}',
        viscosity=chance.choice([0.1, 0.3, 1.0]), gamma=chance.choice([0.5, 1.0]))
    anchored = f", {anchoring}" if box in AXES else ""
    return text, f"{flow}, {box}{anchored}, {'noise' if noise else 'waves'}, {across} x {across}, core {core} spacings"


def largest_rise(energy):
    """Of the energy above the least before, over what was dissipated by then."""
    least = numpy.minimum.accumulate(energy)[:-1]
    rise = energy[1:] - least
    dissipated = energy[0] - least
    return max((r / d if d > 0.0 else numpy.inf for r, d in zip(rise, dissipated) if r > 0.0), default=0.0)


def energies(mesogen, text, folder, *settings):
    case = os.path.join(folder, "case.toml")
    with open(case, "w", encoding="utf-8") as file:
        file.write(text)
    subprocess.run([mesogen, "run", case, "--output", os.path.join(folder, "run"), "--overwrite", *settings],
                   check=True, capture_output=True)
    with h5py.File(os.path.join(folder, "run", "results.h5")) as file:
        values = {name: numpy.asarray(file[f"observables/{name}/value"])
                  for name in ("flow/kinetic_energy", "flow/compression_energy", "order/free_energy")}
    values["flow/compression_energy"] = numpy.nan_to_num(values["flow/compression_energy"])  # none: incompressible
    return values


def main():
    mesogen = os.path.abspath(sys.argv[1])
    number = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(number):
            text, words = start(seed)
            energy = sum(energies(mesogen, text, folder).values())
            rise = largest_rise(energy)
            failed += not rise <= MOST
            print(f"{seed:3d}: rise {rise:.2e} of {energy[0] - energy.min():.3g} J/m dissipated; {words}", flush=True)
    print(f"{number - failed} of {number} starts: no rise above {MOST:g} of what was dissipated")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
