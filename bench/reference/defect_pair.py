#!/usr/bin/python3
"""The reference of cases/accuracy/defect_pair: the distance of the pair against time, until it has vanished.

    defect_pair.py [--points 256] [--step 0.005]

The defects are the zeros of Q, found by Newton's method on the Fourier series."""

import argparse

import numpy as np

from spectral import Model, Solver

LENGTH, CORE = 8.0, 0.3  # m
PAIR = ((3.0, 4.0, 0.5), (5.0, 4.0, -0.5))  # x, y in m, charge


def turned(dx, dy):
    """Angle around a unit defect and its images in a square box, as a [director] of type "defects" has it."""
    a, b = np.pi * dx / LENGTH, np.pi * dy / LENGTH
    angle = np.arctan2(np.cos(a) * np.tanh(b), np.sin(a))
    for m in range(1, 8):
        scale = np.cosh(2.0 * m * np.pi)
        angle += np.arctan2(np.sin(2.0 * a) * np.sinh(2.0 * b) / scale,
                            1.0 - np.cos(2.0 * a) * np.cosh(2.0 * b) / scale)
    return angle


def director(x, y):
    """(Q11, Q12) of the start."""
    moment_x = sum(charge * at for at, _, charge in PAIR)
    moment_y = sum(charge * at for _, at, charge in PAIR)
    angle = -np.round(2.0 * moment_y / LENGTH) * np.pi / LENGTH * x
    angle = angle + (np.round(2.0 * moment_x / LENGTH) - 2.0 * moment_x / LENGTH) * np.pi / LENGTH * y
    order = 1.0
    for at_x, at_y, charge in PAIR:
        dx, dy = x - at_x, y - at_y
        angle = angle + charge * turned(dx, dy)
        square = (dx - LENGTH * np.round(dx / LENGTH)) ** 2 + (dy - LENGTH * np.round(dy / LENGTH)) ** 2
        order = order * np.sqrt(square / (square + 2.0 * CORE**2))
    return order * np.cos(2.0 * angle), order * np.sin(2.0 * angle)


def distances(points, step, times):
    """[(time, distance)], s and m, until the pair has vanished."""
    scene = Solver(Model(rotation=1.0, elastic=0.1, flow="none"), LENGTH, points, director)
    rows, at = [], [np.array(PAIR[0][:2]), np.array(PAIR[1][:2])]
    for time in times:
        scene.advance(time, step)
        at = [scene.zero_near(*place, radius=0.5) for place in at]
        if any(place is None for place in at) or np.hypot(*(at[1] - at[0])) < 1e-6 * LENGTH:
            break
        rows.append((time, float(np.hypot(*(at[1] - at[0])))))
    return rows


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--points", type=int, default=256)
    parser.add_argument("--step", type=float, default=0.01, help="s")
    options = parser.parse_args()
    for time, distance in distances(options.points, options.step, np.arange(0.25, 20.0, 0.25)):
        print(f"t = {time:.2f} s: {distance:.6f} m", flush=True)
