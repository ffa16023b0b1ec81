"""From particles to a regular grid, and back. The grid is periodic but where walls bound the box.

Gridded fields are arrays of shape (ny, nx), row = y: the order that images have. The value at [j, i] belongs to the
centre of cell (i, j), at x = (i + 1/2) Lx / nx, y = (j + 1/2) Ly / ny.
"""

from functools import cached_property

import numpy as np

EMPTY = 1e-9  # sums of weights below this are of cells without particles


class Grid:
    """A grid of nx x ny cells over a box with its origin at 0.

    box: (Lx, Ly). shape: (nx, ny), at least 4 each. periodic: by axis; False between walls. length_unit: of the box, as
    text.
    """

    def __init__(self, box, shape, periodic=(True, True), length_unit="m"):
        self.box = np.asarray(box, dtype=float)[:2]
        nx, ny = (int(n) for n in shape)
        if nx < 4 or ny < 4:
            raise ValueError(f"a grid needs at least 4 x 4 cells, not {nx} x {ny}")
        self.shape, self.length_unit = (ny, nx), length_unit
        self.periodic = tuple(bool(p) for p in periodic)
        self.cell = self.box / (nx, ny)
        self.x = (np.arange(nx) + 0.5) * self.cell[0]
        self.y = (np.arange(ny) + 0.5) * self.cell[1]
        self.extent = (0.0, self.box[0], 0.0, self.box[1])

    @classmethod
    def for_particles(cls, box, count, refine=1.0, periodic=(True, True), length_unit="m"):
        """The grid whose cells are as wide as the mean particle spacing / refine. count: number of particles."""
        box = np.asarray(box, dtype=float)[:2]
        spacing = np.sqrt(box.prod() / max(count, 1)) / refine
        return cls(box, np.maximum(4, np.rint(box / spacing)).astype(int), periodic, length_unit)

    def to_the_faces(self, *fields):
        """x, y and fields of shape (ny, nx) with one cell more on each side, so that lines drawn of them end at the faces
        of the box."""
        x, y = (np.concatenate([[c[0] - d], c, [c[-1] + d]]) for c, d in zip((self.x, self.y), self.cell))
        for axis in (0, 1):
            sides = [(1, 1) if a == 1 - axis else (0, 0) for a in (0, 1)]
            beyond = "wrap" if self.periodic[axis] else "edge"
            fields = [np.pad(field, sides, mode=beyond) for field in fields]
        return x, y, *fields

    def __repr__(self):
        lengths = " x ".join(f"{length:g} {self.length_unit}" for length in self.box)
        return f"<mesogen.Grid {self.shape[1]} x {self.shape[0]} cells over {lengths}>"


class Deposit:
    """Brings particle values to a grid, weighted by the cubic B-spline of the 4 x 4 cells around each particle.

    Made once for a set of positions, used for many fields:

    >>> deposit = Deposit(Grid.for_particles(run.box, run.count), run["position"])
    >>> u = deposit(run["velocity"][:, 0])        # shape (ny, nx)
    """

    def __init__(self, grid, position):
        self.grid = grid
        position = np.asarray(position, dtype=float)
        self._index, self._weight, self._offset = _stencil(grid, position, _b_spline)
        self._read = _stencil_weights(grid, position, _keys)
        self.weight = self._sum(1.0)  # by cell; their total is the number of particles

    @cached_property
    def coverage(self):
        """How much of the surroundings of each cell is fluid, shape (ny, nx): 1 in the fluid, 1/2 at the surface of a
        solid, 0 in it. All 1 where particles fill the box."""
        weight = self.weight.reshape(self.grid.shape)
        if not (weight < EMPTY).any():
            return np.ones(self.grid.shape)
        return np.minimum(weight / np.median(weight[weight > EMPTY]), 1.0)

    @property
    def interior(self):
        """Which cells hold fluid, shape (ny, nx)."""
        return self.coverage > 0.5

    def __call__(self, values):
        """The field at the cell centres, shape (ny, nx), from one number per particle; for smooth fields.

        A linear fit to the particles around each centre (moving least squares: disorder does not matter for linear
        fields), then once more what this missed at the particles: smooth fields to fourth order on a lattice. At jumps
        it overshoots; see average.
        """
        values = np.asarray(values, dtype=float)
        field = self._fitted(values)
        at_particles = (field.ravel()[self._index] * self._read).sum(axis=0)
        return field + self._fitted(values - at_particles)

    def average(self, values):
        """The weighted mean at the cell centres, shape (ny, nx): blurs, but never leaves the range of the values."""
        known = self.weight > EMPTY
        field = self._sum(np.asarray(values, dtype=float)) / np.where(known, self.weight, 1.0)
        return self._filled(field, known)

    def _sum(self, values):
        cells = self.grid.shape[0] * self.grid.shape[1]
        return np.bincount(self._index.ravel(), (self._weight * values).ravel(), cells)

    @cached_property
    def _fit(self):
        """First row of the inverse of the 3 x 3 moment matrix of (1, dx, dy) at each cell: gives the value there."""
        dx, dy = self._offset
        s, sx, sy = self.weight, self._sum(dx), self._sum(dy)
        sxx, sxy, syy = self._sum(dx * dx), self._sum(dx * dy), self._sum(dy * dy)
        row = np.stack([sxx * syy - sxy**2, sxy * sy - sx * syy, sx * sxy - sxx * sy])
        determinant = s * row[0] + sx * row[1] + sy * row[2]
        # Too few particles for a slope: their mean instead. A lattice of one particle per cell has s^3 / 9.
        sound = determinant > 1e-3 * np.maximum(s, EMPTY) ** 3
        mean = np.stack([1 / np.maximum(s, EMPTY), np.zeros_like(s), np.zeros_like(s)])
        return np.where(sound, row / np.where(sound, determinant, 1.0), mean)

    def _fitted(self, values):
        dx, dy = self._offset
        moments = self._sum(values), self._sum(values * dx), self._sum(values * dy)
        return self._filled(sum(a * b for a, b in zip(self._fit, moments)), self.weight > EMPTY)

    def _filled(self, field, known):
        """The field with cells that no particle reaches grown in from their neighbours, layer by layer."""
        field, known = field.reshape(self.grid.shape), known.reshape(self.grid.shape)
        while not known.all() and known.any():
            total, count = np.zeros(field.shape), np.zeros(field.shape)
            for axis in (0, 1):
                for step in (-1, 1):
                    total += self._beside(np.where(known, field, 0.0), step, axis)
                    count += self._beside(known, step, axis)
            reached = ~known & (count > 0)
            field = np.where(reached, total / np.maximum(count, 1), field)
            known = known | reached
        return field

    def _beside(self, field, step, axis):
        """The field of the neighbouring cells along an axis; 0 behind a wall."""
        moved = np.roll(field, step, axis)
        if not self.grid.periodic[1 - axis]:
            moved[(slice(None),) * axis + (0 if step > 0 else -1,)] = 0
        return moved


def deposit(position, values, box, shape=None, periodic=(True, True), length_unit="m"):
    """(Grid, gridded field) of one particle field; see Deposit. shape: (nx, ny), by default one particle per cell."""
    if shape is None:
        grid = Grid.for_particles(box, len(position), 1.0, periodic, length_unit)
    else:
        grid = Grid(box, shape, periodic, length_unit)
    return grid, Deposit(grid, position)(values)


def sample(field, grid, position):
    """A gridded field at positions (N, 2), by cubic convolution (Keys 1981, third order); shape (N,)."""
    index, weight, _ = _stencil(grid, np.asarray(position, dtype=float), _keys)
    return (np.asarray(field, dtype=float).ravel()[index] * weight).sum(axis=0)


def gradient(field, grid):
    """(d/dx, d/dy) of a gridded field, by central differences of fourth order; of second order beside a wall."""
    field = np.asarray(field, dtype=float)

    def slope(axis):
        width = grid.cell[1 - axis]
        near = np.roll(field, -1, axis) - np.roll(field, 1, axis)
        far = np.roll(field, -2, axis) - np.roll(field, 2, axis)
        inner = (8 * near - far) / (12 * width)
        if grid.periodic[1 - axis]:
            return inner
        place = np.arange(field.shape[axis])
        beside = np.expand_dims((place < 2) | (place >= len(place) - 2), 1 - axis)
        return np.where(beside, np.gradient(field, width, axis=axis, edge_order=2), inner)

    return slope(1), slope(0)


def vorticity(u, v, grid):
    """dv/dx - du/dy of a gridded velocity (1/s)."""
    return gradient(v, grid)[0] - gradient(u, grid)[1]


def _b_spline(f):
    """Cubic B-spline at the four cells around a point, f in [0, 1) past the second of them; the weights sum to 1."""
    return (1 - f) ** 3 / 6, (4 - 6 * f**2 + 3 * f**3) / 6, (1 + 3 * f + 3 * f**2 - 3 * f**3) / 6, f**3 / 6


def _keys(f):
    """Cubic convolution, likewise."""
    return (
        (-f + 2 * f**2 - f**3) / 2,
        (2 - 5 * f**2 + 3 * f**3) / 2,
        (f + 4 * f**2 - 3 * f**3) / 2,
        (f**3 - f**2) / 2,
    )


def _stencil(grid, position, weights_of):
    """The 4 x 4 cells around each position, all of shape (16, N): their flat numbers, their weights, and the offsets
    (dx, dy) of the position from their centres, in cells."""
    (column, dx), (row, dy) = (_along(grid, position, axis) for axis in (0, 1))
    shape = (4, 4, len(position))
    index = (row[:, None] * grid.shape[1] + column[None]).reshape(16, -1)
    offset = np.broadcast_to(dx[None], shape).reshape(16, -1), np.broadcast_to(dy[:, None], shape).reshape(16, -1)
    return index, _stencil_weights(grid, position, weights_of), offset


def _stencil_weights(grid, position, weights_of):
    across, up = (_weights_along(grid, position, axis, weights_of) for axis in (0, 1))
    return (up[:, None] * across[None]).reshape(16, -1)


def _weights_along(grid, position, axis, weights_of):
    """Weights of the four cells along an axis, (4, N). Behind a wall there are none: nothing is spread to them, and
    what is read from them is extrapolated linearly from the two before the wall."""
    cell, offset = _cells_along(grid, position, axis)
    weight = np.stack(weights_of(offset[1]))
    if grid.periodic[axis]:
        return weight
    last = grid.shape[1 - axis] - 1
    behind = np.maximum(-cell, 0), np.maximum(cell - last, 0)
    kept = np.where((cell < 0) | (cell > last), 0.0, weight)
    if weights_of is _keys:
        for depth, (first, second) in zip(behind, ((0, 1), (last, last - 1))):
            once, more = (weight * (depth > 0)).sum(axis=0), (weight * depth).sum(axis=0)
            kept += np.where(cell == first, once + more, 0.0) - np.where(cell == second, more, 0.0)
    return kept


def _along(grid, position, axis):
    """The four cells around each position along an axis: numbers, and offsets of the position in cells; (4, N).
    A cell behind a wall goes by the number of the one before it."""
    cell, offset = _cells_along(grid, position, axis)
    cells = grid.shape[1 - axis]
    return np.mod(cell, cells) if grid.periodic[axis] else np.clip(cell, 0, cells - 1), offset


def _cells_along(grid, position, axis):
    """The same, numbered on beyond the faces."""
    place = position[:, axis] / grid.cell[axis] - 0.5
    first = np.floor(place)
    around = np.arange(-1, 3)[:, None]
    return first.astype(np.int64) + around, place - first - around
