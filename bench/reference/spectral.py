"""A pseudo-spectral solver of the equations of Mesogen on a periodic square, in two dimensions, for reference answers.

    dQ/dt + u . grad Q = lambda E - 2 lambda (Q : E) Q + rotation + Gamma H,   H = -A Q - C Q Tr(Q^2) + K lap Q
    rho (dw/dt + u . grad w) = mu lap w + curl div(-zeta Q),                  w = dv/dx - du/dy, div u = 0

with the rotation (-w Q12, w Q11) and Q = (Q11, Q12). Space: Fourier series, products at the grid points, the upper
third of the wave numbers cut off (S. A. Orszag, J. Atmos. Sci. 28, 1074 (1971)). Time: Runge-Kutta of fourth order with
the diffusion in an integrating factor. All quantities in SI units. Needs numpy only."""

from dataclasses import dataclass

import numpy as np


@dataclass
class Model:
    """Material of a nematic and its flow. flow: "inertia", "stokes" (no inertia) or "none" (it rests)."""

    rotation: float  # Gamma, 1/(Pa s)
    elastic: float  # K, N
    alignment: float = 0.0  # lambda
    bulk_a: float = -1.0  # A, Pa
    bulk_c: float = 0.5  # C, Pa
    activity: float = 0.0  # zeta, Pa
    density: float = 1.0  # rho, kg/m^3
    viscosity: float = 1.0  # mu, Pa s
    flow: str = "inertia"

    def __post_init__(self):
        if self.flow not in ("inertia", "stokes", "none"):
            raise ValueError(f'flow is "{self.flow}", not "inertia", "stokes" or "none"')


class Solver:
    """The fields on points x points, at time `time`.

    tensor: function (x, y) -> (Q11, Q12) of the start, on arrays of coordinates in m. The fluid starts at rest."""

    def __init__(self, model, length, points, tensor):
        self.model, self.length, self.points, self.time = model, length, points, 0.0
        k = 2.0 * np.pi / length * np.fft.fftfreq(points, 1.0 / points)
        self.kx, self.ky = k[None, : points // 2 + 1].copy(), k[:, None]
        self.kx[0, -1] = abs(self.kx[0, -1])
        self.square = self.kx**2 + self.ky**2
        self.inverse = np.where(self.square > 0.0, 1.0 / np.where(self.square > 0.0, self.square, 1.0), 0.0)
        largest = 2.0 * np.pi / length * points / 3.0
        self.kept = (np.abs(self.kx) < largest) & (np.abs(self.ky) < largest)
        x = length * np.arange(points) / points
        q11, q12 = tensor(x[None, :], x[:, None])
        self.state = [self._spectrum(q11 + 0.0 * x[:, None]), self._spectrum(q12 + 0.0 * x[:, None])]
        if model.flow == "inertia":
            self.state.append(np.zeros_like(self.state[0]))
        diffusion = [model.rotation * model.elastic] * 2 + [model.viscosity / model.density]
        self.decay = [-diffusion[n] * self.square for n in range(len(self.state))]
        self.factors = {}

    def _spectrum(self, values):
        return np.fft.rfft2(values) * self.kept

    def _values(self, spectrum):
        return np.fft.irfft2(spectrum, s=(self.points, self.points))

    def _force_curl(self, state):
        """Spectrum of curl div(-zeta Q), Pa/m^2."""
        return self.model.activity * ((self.kx**2 - self.ky**2) * state[1] - 2.0 * self.kx * self.ky * state[0])

    def _vorticity(self, state):
        """Spectrum of w; zeros where nothing flows."""
        if self.model.flow == "inertia":
            return state[2]
        if self.model.flow == "stokes":
            return self._force_curl(state) * self.inverse / self.model.viscosity
        return np.zeros_like(state[0])

    def _rates(self, state):
        """Spectra of all that changes the state, diffusion apart."""
        m, values = self.model, self._values
        q11, q12 = values(state[0]), values(state[1])
        bulk = -m.rotation * (m.bulk_a + 2.0 * m.bulk_c * (q11**2 + q12**2))
        if m.flow == "none":
            return [self._spectrum(bulk * q11), self._spectrum(bulk * q12)]
        vorticity = self._vorticity(state)
        stream = vorticity * self.inverse
        u, v, w = values(1j * self.ky * stream), values(-1j * self.kx * stream), values(vorticity)
        e11 = values(-self.kx * self.ky * stream)
        e12 = values(0.5 * (self.kx**2 - self.ky**2) * stream)
        along = 4.0 * m.alignment * (q11 * e11 + q12 * e12)  # 2 lambda Q : E

        def carried(spectrum):
            return u * values(1j * self.kx * spectrum) + v * values(1j * self.ky * spectrum)

        rates = [self._spectrum(m.alignment * e11 - along * q11 - w * q12 + bulk * q11 - carried(state[0])),
                 self._spectrum(m.alignment * e12 - along * q12 + w * q11 + bulk * q12 - carried(state[1]))]
        if m.flow == "inertia":
            rates.append(self._force_curl(state) / m.density - self._spectrum(carried(state[2])))
        return rates

    def _step(self, dt):
        if dt not in self.factors:
            self.factors = {dt: [np.exp(0.5 * dt * rate) for rate in self.decay]}
        half = self.factors[dt]
        y = self.state
        a = self._rates(y)
        b = self._rates([e * (f + 0.5 * dt * r) for e, f, r in zip(half, y, a)])
        c = self._rates([e * f + 0.5 * dt * r for e, f, r in zip(half, y, b)])
        d = self._rates([e * (e * f + dt * r) for e, f, r in zip(half, y, c)])
        self.state = [e * (e * f + dt / 6.0 * (e * p + 2.0 * (q + r))) + dt / 6.0 * s
                      for e, f, p, q, r, s in zip(half, y, a, b, c, d)]

    def advance(self, time, dt):
        """To this time, s, in equal steps of about dt."""
        steps = max(1, round((time - self.time) / dt))
        dt = (time - self.time) / steps
        for _ in range(steps):
            self._step(dt)
        self.time = time
        if not np.isfinite(self.state[0]).all():
            raise ArithmeticError(f"the solution is lost at t = {time} s: choose a shorter step")

    def tensor(self):
        """Q11 and Q12 at the grid points, points x points, y first."""
        return self._values(self.state[0]), self._values(self.state[1])

    def mean_order(self):
        return float(np.mean(np.hypot(*self.tensor())))

    def v_rms(self):
        """Root of the mean square velocity, m/s."""
        stream = self._vorticity(self.state) * self.inverse
        return float(np.sqrt(np.mean(self._values(1j * self.ky * stream) ** 2 +
                                     self._values(-1j * self.kx * stream) ** 2)))

    def vorticity_rms(self):
        """Root of the mean square vorticity, 1/s."""
        return float(np.sqrt(np.mean(self._values(self._vorticity(self.state)) ** 2)))

    def tensor_at(self, x, y):
        """(Q11, Q12) and its gradient [[d/dx Q11, d/dy Q11], [d/dx Q12, d/dy Q12]] at any one point, by the series."""
        twice = np.where((self.kx > 0.0) & (self.kx < np.pi * self.points / self.length), 2.0, 1.0)
        wave = twice * np.exp(1j * (self.kx * x + self.ky * y)) / self.points**2
        value = np.array([np.real(np.sum(q * wave)) for q in self.state[:2]])
        slope = np.array([[np.real(np.sum(1j * k * q * wave)) for k in (self.kx, self.ky)] for q in self.state[:2]])
        return value, slope

    def zero_near(self, x, y, radius):
        """The point (x, y), m, where Q is zero, by Newton's method from a guess; None if that leads off by more than
        `radius`."""
        begun = np.array([x, y])
        at = begun.copy()
        for _ in range(30):
            value, slope = self.tensor_at(*at)
            if abs(np.linalg.det(slope)) < 1e-12:
                return None
            way = np.linalg.solve(slope, value)
            at -= way
            if np.hypot(*(at - begun)) > radius:
                return None
            if np.hypot(*way) < 1e-12 * self.length:
                return at
        return None
