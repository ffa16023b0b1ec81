#!/usr/bin/python3
"""The reference of cases/accuracy/benchmark. Prints a row a time; --points 128, --step 0.01, --flow stokes."""

import argparse

import numpy as np

from spectral import Model, Solver

LENGTH = 10.0  # m
WAVES = ((1, 0, 0.05, 0.3), (0, 1, 0.03, 1.1), (1, 1, 0.02, 2.0), (2, -1, 0.02, 0.7), (3, 1, 0.01, 1.9))


def director(x, y):
    """(Q11, Q12) of the start: five waves of the angle, order 1."""
    angle = sum(a * np.cos(2.0 * np.pi * (mx * x + my * y) / LENGTH + phase) for mx, my, a, phase in WAVES)
    return np.cos(2.0 * angle), np.sin(2.0 * angle)


def solver(points, flow="inertia"):
    """The scene at t = 0."""
    model = Model(rotation=0.4, elastic=0.02, alignment=0.7, activity=0.05, viscosity=2.0 / 3.0, flow=flow)
    return Solver(model, LENGTH, points, director)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--points", type=int, default=64)
    parser.add_argument("--step", type=float, default=0.02, help="s")
    parser.add_argument("--flow", choices=["inertia", "stokes"], default="inertia")
    parser.add_argument("--end", type=float, default=60.0, help="s")
    options = parser.parse_args()
    scene = solver(options.points, options.flow)
    print("t/s  v_rms/(m/s)  vorticity_rms s  mean_order")
    for time in np.arange(10.0, options.end + 1.0, 10.0):
        scene.advance(time, options.step)
        print(f"{time:.0f}   {scene.v_rms():.8f}   {scene.vorticity_rms():.8f}   {scene.mean_order():.7f}", flush=True)
