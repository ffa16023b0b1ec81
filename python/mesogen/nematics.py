"""Director, order and topological defects of a two-dimensional nematic.

The order tensor is Q = q (cos 2 theta, sin 2 theta) = (Q11, Q12): theta the director's angle, q the order.
"""

from collections import namedtuple

import numpy as np

from . import grid as grids

Director = namedtuple("Director", "angle order")


def director(q11, q12):
    """Director angle in (-pi/2, pi/2] (rad) and order from the components of the order tensor, same shape as these."""
    q11, q12 = np.asarray(q11, dtype=float), np.asarray(q12, dtype=float)
    # Adding 0.0 turns -0.0 into 0.0: the same director must not be given as both -pi/2 and pi/2.
    return Director(0.5 * np.arctan2(q12 + 0.0, q11), np.hypot(q11, q12))


def find_defects(q11, q12, grid):
    """Defects of charge +1/2 and -1/2 of a gridded order tensor.

    q11, q12: arrays of grid.shape. The director is followed around every square of four neighbouring cell centres;
    where it turns by +-pi there is a defect, placed at the zero of the bilinear Q in that square.

    Returns an array (defects, 4) of x (m), y (m), charge, orientation (rad). The orientation is a direction in which
    the director points away from the core: the tail of a +1/2 (opposite to its round head), a leg of a -1/2, which has
    three, 120 degrees apart: in (-pi, pi] and (-pi/3, pi/3].
    """
    angle = director(q11, q12).angle
    corners = _corners(angle)
    turned = sum(_half_turn(corners[(k + 1) % 4] - corners[k]) for k in range(4))
    charge = 0.5 * np.rint(turned / np.pi)
    # No square reaches through a wall.
    for axis, periodic in enumerate(grid.periodic):
        if not periodic:
            charge[(slice(None),) * (1 - axis) + (-1,)] = 0
    row, column = np.nonzero(np.abs(charge) == 0.5)
    charge = charge[row, column]

    a = [corner[row, column] for corner in _corners(np.asarray(q11, dtype=float))]
    b = [corner[row, column] for corner in _corners(np.asarray(q12, dtype=float))]
    across, up = _bilinear_zero(a, b)
    x = (grid.x[column] + across * grid.cell[0]) % grid.box[0]
    y = (grid.y[row] + up * grid.cell[1]) % grid.box[1]

    # Gradient over the 4 x 4 cells around the core: the mean of central differences at the four corners.
    slopes = [grids.gradient(q, grid) for q in (q11, q12)]
    (d11dx, d11dy), (d12dx, d12dy) = [[sum(_corners(d))[row, column] for d in slope] for slope in slopes]
    plus = np.arctan2(d12dx - d11dy, d11dx + d12dy)
    minus = np.arctan2(d12dx + d11dy, d11dx - d12dy) / 3
    return np.stack([x, y, charge, np.where(charge > 0, plus, minus)], axis=1)


def _corners(field):
    """The field at the four corners of the square up and right of each cell centre, counter-clockwise."""
    right = np.roll(field, -1, axis=1)
    return [field, right, np.roll(right, -1, axis=0), np.roll(field, -1, axis=0)]


def _half_turn(angle):
    """An angle between directors, which have no head: brought to [-pi/2, pi/2]."""
    return angle - np.pi * np.rint(angle / np.pi)


def _bilinear_zero(a, b, iterations=6):
    """Where both bilinear functions, given at corners (0,0), (1,0), (1,1), (0,1), vanish; Newton, kept inside."""
    s = np.full(a[0].shape, 0.5)
    t = s.copy()
    for _ in range(iterations):
        values, slopes = [], []
        for c in (a, b):
            values.append((1 - s) * (1 - t) * c[0] + s * (1 - t) * c[1] + s * t * c[2] + (1 - s) * t * c[3])
            slopes.append(((1 - t) * (c[1] - c[0]) + t * (c[2] - c[3]), (1 - s) * (c[3] - c[0]) + s * (c[2] - c[1])))
        determinant = slopes[0][0] * slopes[1][1] - slopes[0][1] * slopes[1][0]
        safe = np.where(np.abs(determinant) > 1e-300, determinant, 1.0)
        ds = np.where(safe == determinant, (values[0] * slopes[1][1] - values[1] * slopes[0][1]) / safe, 0.0)
        dt = np.where(safe == determinant, (values[1] * slopes[0][0] - values[0] * slopes[1][0]) / safe, 0.0)
        s, t = np.clip(s - ds, 0, 1), np.clip(t - dt, 0, 1)
    return s, t
