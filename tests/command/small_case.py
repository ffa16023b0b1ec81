"""A small case that is right and shows all that a run has, for the tests of the command and of its endurance."""

CASE = """\
title = "A small nematic"
[domain]
size = [1.6, 1.6]
boundary = "periodic_ghosts"
[particles]
spacing = 0.1
[kernel]
type = "quintic"
smoothing_length = 1.3333
[director]
type = "modes"
modes = [[1, 0, 0.2, 0.3], [0, 1, 0.1, 1.1]]
[physics.flow]
type = "wcsph"
density = 1.0
viscosity = 0.5
[physics.nematic]
type = "beris_edwards"
rotational_diffusivity = 0.4
flow_alignment = 0.7
elastic_constant = 0.02
bulk = { A = -1.0, B = 0.0, C = 0.5 }
[physics.activity]
type = "active_stress"
activity = 0.05
[time]
end = 0.1
[observers.flow]
type = "flow_statistics"
interval = 0.05
[output]
interval = 0.05
[run]
precision = "double"
"""
