#!/usr/bin/python3
"""The exact answer of cases/accuracy/flow_alignment: a nematic between two plates, one of which begins to move.

The velocity u(y, t) of the start-up of plane Couette flow is a Fourier series (Batchelor, An Introduction to Fluid
Dynamics, 1967, section 4.3); without elasticity (K = 0) the order tensor at each height obeys an ordinary equation with
the shear g = du/dy (E12 = g / 2, vorticity -g):

    Q11' = -2 lambda g Q12 Q11 + g Q12 + Gamma H11,   H = -Q (A + 2 C q^2)
    Q12' = lambda g / 2 - 2 lambda g Q12 Q12 - g Q11 + Gamma H12

At last cos(2 theta) = 2 q / lambda. Prints the angle of the mean tensor and the mean order, in SI units."""

import numpy as np

HEIGHT, SPEED, VISCOSITY = 1.0, 1.0, 0.1  # m, m/s, kinematic: m^2/s
ROTATION, ALIGNMENT, BULK_A, BULK_C = 1.0, 2.5, -10.0, 5.0
TIMES = (1.0, 2.0, 4.0)  # s


def shear(y, time):
    """du/dy, 1/s, for t > 0; the plate at y = HEIGHT moves with SPEED from t = 0, the other rests."""
    n = np.arange(1, 400)[:, None]
    k = n * np.pi / HEIGHT
    decay = np.exp(-VISCOSITY * k**2 * time)
    return SPEED / HEIGHT * (1.0 + 2.0 * np.sum((-1.0) ** n * decay * np.cos(k * y), axis=0))


def rate(q, g):
    """dQ/dt of Q = (Q11, Q12) under the shear g."""
    bulk = -ROTATION * (BULK_A + 2.0 * BULK_C * (q[0] ** 2 + q[1] ** 2))
    return np.array([-2.0 * ALIGNMENT * g * q[1] * q[0] + g * q[1] + bulk * q[0],
                     ALIGNMENT * g / 2.0 - 2.0 * ALIGNMENT * g * q[1] ** 2 - g * q[0] + bulk * q[1]])


def answer(heights=100, step=1e-3):
    """[(time, angle of the mean tensor, mean order)]: Gauss-Legendre over the height, Runge-Kutta 4 in
    the root of time."""
    nodes, weights = np.polynomial.legendre.leggauss(heights)
    y, weights = 0.5 * HEIGHT * (nodes + 1.0), 0.5 * weights
    q = np.array([np.ones(heights), np.zeros(heights)])
    rows = []

    # At t = 0 the shear is singular at the plate: time is replaced by s, t = s^2.
    def slope(s, value):
        return 2.0 * s * rate(value, shear(y, s * s)) if s > 0.0 else np.zeros_like(value)

    s = 0.0
    for end in np.sqrt(TIMES):
        count = round((end - s) / step)
        ds = (end - s) / count
        for _ in range(count):
            a = slope(s, q)
            b = slope(s + ds / 2, q + ds / 2 * a)
            c = slope(s + ds / 2, q + ds / 2 * b)
            d = slope(s + ds, q + ds * c)
            q = q + ds / 6 * (a + 2 * b + 2 * c + d)
            s += ds
        mean = q @ weights
        rows.append((end**2, 0.5 * np.arctan2(mean[1], mean[0]), np.hypot(q[0], q[1]) @ weights))
    return rows


if __name__ == "__main__":
    for time, angle, order in answer():
        print(f"t = {time:g} s: mean_director_angle {angle:.6f} rad, mean_order {order:.6f}")
