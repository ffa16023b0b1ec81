"""Particles to grid and back."""

import unittest

import numpy as np
import synthetic

from mesogen import grid


def disordered(cells, seed=3):
    position = synthetic.lattice(cells)
    spacing = synthetic.BOX / cells
    return (position + np.random.default_rng(seed).uniform(-0.25, 0.25, position.shape) * spacing) % synthetic.BOX


def cosine(x, y):
    return np.cos(2 * np.pi * (2 * x / synthetic.BOX[0] + y / synthetic.BOX[1]) + 0.4)


def on(cells):
    return np.meshgrid(cells.x, cells.y)


class Layout(unittest.TestCase):
    def test_rows_are_y(self):
        cells = grid.Grid((10, 5), (20, 5), length_unit="um")
        self.assertEqual(repr(cells), "<mesogen.Grid 20 x 5 cells over 10 um x 5 um>")
        self.assertEqual(cells.shape, (5, 20))
        np.testing.assert_allclose(cells.x[[0, -1]], [0.25, 9.75])
        np.testing.assert_allclose(cells.y, [0.5, 1.5, 2.5, 3.5, 4.5])
        self.assertEqual(cells.extent, (0, 10, 0, 5))

    def test_one_cell_a_particle(self):
        self.assertEqual(grid.Grid.for_particles(synthetic.BOX, 288).shape, (12, 24))
        self.assertEqual(grid.Grid.for_particles(synthetic.BOX, 288, refine=2).shape, (24, 48))

    def test_refuses_too_few_cells(self):
        with self.assertRaises(ValueError) as error:
            grid.Grid((10, 5), (3, 8))
        self.assertIn("at least 4 x 4 cells, not 3 x 8", str(error.exception))


class Walls(unittest.TestCase):
    """Between walls nothing reaches from one side to the other: linear fields stay linear up to them."""

    def test_linear_is_exact_up_to_the_walls(self):
        position = disordered((48, 24))
        cells, field = grid.deposit(
            position, 1.7 + 0.2 * position[:, 0] - 0.3 * position[:, 1], synthetic.BOX, periodic=(False, False)
        )
        x, y = on(cells)
        np.testing.assert_allclose(field, 1.7 + 0.2 * x - 0.3 * y, atol=1e-11)
        slope_x, slope_y = grid.gradient(field, cells)
        np.testing.assert_allclose(slope_x, 0.2, atol=1e-10)
        np.testing.assert_allclose(slope_y, -0.3, atol=1e-10)

    def test_one_axis_with_walls_leaves_the_other_periodic(self):
        position = disordered((48, 24))
        wave = np.cos(2 * np.pi * position[:, 0] / synthetic.BOX[0])
        cells, field = grid.deposit(position, wave + position[:, 1], synthetic.BOX, periodic=(True, False))
        x, y = on(cells)
        np.testing.assert_allclose(field, np.cos(2 * np.pi * x / synthetic.BOX[0]) + y, atol=0.03)

    def test_cells_without_particles_grow_from_their_side(self):
        position = synthetic.lattice()
        position = position[position[:, 1] < 0.3 * synthetic.BOX[1]]
        value = np.where(position[:, 1] < 0.15 * synthetic.BOX[1], 1.0, 3.0)
        cells = grid.Grid(synthetic.BOX, synthetic.CELLS, (True, False))
        field = grid.Deposit(cells, position).average(value)
        self.assertGreater(field[-1].min(), 2.5)


class Spreading(unittest.TestCase):
    def test_lattice_transfer_is_known(self):
        # On a lattice, the spline's weights 1/6, 4/6, 1/6 damp cos(k x) by (2 + cos k d) / 3 along each axis.
        # The second pass then leaves 1 - (1 - d)^2 of it, and the mean d.
        position, cells = synthetic.lattice(), grid.Grid(synthetic.BOX, synthetic.CELLS)
        deposit, exact = grid.Deposit(cells, position), cosine(*on(cells))
        kept = np.prod([(2 + np.cos(2 * np.pi * n / c)) / 3 for n, c in ((2, 24), (1, 12))])
        np.testing.assert_allclose(deposit.average(cosine(*position.T)), kept * exact, atol=1e-13)
        np.testing.assert_allclose(deposit(cosine(*position.T)), (1 - (1 - kept) ** 2) * exact, atol=1e-13)

    def test_linear_is_exact_on_disordered_particles(self):
        position = disordered((48, 24))
        cells, field = grid.deposit(position, 1.7 + 0.2 * position[:, 0] - 0.3 * position[:, 1], synthetic.BOX)
        x, y = on(cells)
        inside = (slice(8, -8), slice(8, -8))  # away from the faces, where it jumps
        np.testing.assert_allclose(field[inside], (1.7 + 0.2 * x - 0.3 * y)[inside], atol=1e-12)

    def test_average_stays_within_the_values(self):
        position = disordered((24, 12))
        field = grid.Deposit(grid.Grid(synthetic.BOX, (48, 24)), position).average(position[:, 0] < 5)
        self.assertEqual((field.min(), field.max()), (0, 1))

    def test_weights_wrap_over_the_faces(self):
        cells = grid.Grid(synthetic.BOX, (10, 5))
        corner = grid.Deposit(cells, np.array([[0.0, 0.0]])).weight.reshape(cells.shape)
        self.assertAlmostEqual(corner.sum(), 1, places=14)
        np.testing.assert_allclose(corner[[0, -1, 0, -1], [0, 0, -1, -1]], (23 / 48) ** 2)

    def test_cosine_converges_with_fourth_order(self):
        errors = []
        for refine in (2, 4):
            position = synthetic.lattice((32 * refine, 16 * refine))
            cells, field = grid.deposit(position, cosine(*position.T), synthetic.BOX)
            errors.append(np.abs(field - cosine(*on(cells))).max())
        self.assertLess(errors[0], 2e-4)
        self.assertGreater(errors[0] / errors[1], 15)

    def test_cosine_on_disordered_particles(self):
        position = disordered((64, 32))
        cells, field = grid.deposit(position, cosine(*position.T), synthetic.BOX)
        self.assertLess(np.abs(field - cosine(*on(cells))).max(), 0.006)

    def test_cells_that_no_particle_reaches_take_their_neighbours(self):
        position = synthetic.lattice((8, 4))
        _, field = grid.deposit(position, np.where(position[:, 0] < 5, 1.0, 3.0), synthetic.BOX, shape=(80, 40))
        self.assertAlmostEqual(field[20, 20], 1, places=12)
        self.assertAlmostEqual(field[20, 60], 3, places=12)


class Solids(unittest.TestCase):
    def test_half_of_a_cell_at_the_surface_is_fluid(self):
        position = synthetic.lattice(np.array([48, 24]))
        centre, radius = np.array(synthetic.BOX) / 2, 0.3 * min(synthetic.BOX)
        position = position[np.hypot(*(position - centre).T) > radius]
        cells = grid.Grid(synthetic.BOX, (48, 24))
        deposit = grid.Deposit(cells, position)
        x, y = on(cells)
        distance = np.hypot(x - centre[0], y - centre[1]) - radius
        wide = 0.5 * cells.cell.max()
        self.assertTrue(deposit.interior[distance > wide].all())
        self.assertFalse(deposit.interior[distance < -wide].any())
        self.assertEqual(deposit.coverage.max(), 1.0)

    def test_where_particles_fill_the_box_all_is_fluid(self):
        cells = grid.Grid(synthetic.BOX, (24, 12))
        deposit = grid.Deposit(cells, disordered(np.array([24, 12])))
        self.assertEqual(deposit.coverage.min(), 1.0)


class Reading(unittest.TestCase):
    def test_sample_at_cell_centres_is_the_field(self):
        cells = grid.Grid(synthetic.BOX, (8, 6))
        field = np.random.default_rng(1).normal(size=cells.shape)
        centres = np.stack(on(cells), axis=-1).reshape(-1, 2)
        np.testing.assert_allclose(grid.sample(field, cells, centres), field.ravel(), atol=1e-14)

    def test_sample_wraps(self):
        cells = grid.Grid(synthetic.BOX, (64, 32))
        field = cosine(*on(cells))
        place = np.array([[9.99, 4.99], [0.01, 0.01], [19.99, -0.01]])
        np.testing.assert_allclose(grid.sample(field, cells, place), cosine(*place.T), atol=1e-3)

    def test_gradient_converges_with_fourth_order(self):
        errors = []
        for refine in (1, 2):
            cells = grid.Grid(synthetic.BOX, (32 * refine, 16 * refine))
            x, y = on(cells)
            slope = -np.sin(2 * np.pi * (2 * x / 10 + y / 5) + 0.4) * 2 * np.pi / 5
            across, up = grid.gradient(cosine(x, y), cells)
            errors.append(max(np.abs(across - slope).max(), np.abs(up - slope).max()))
        self.assertGreater(errors[0] / errors[1], 15)
        self.assertLess(errors[1], 2e-4)

    def test_vorticity_of_a_known_flow(self):
        cells = grid.Grid(synthetic.BOX, (64, 32))
        deposit = grid.Deposit(cells, synthetic.lattice((64, 32)))
        velocity, _ = synthetic.waves(synthetic.lattice((64, 32)))
        u, v = (deposit(component) for component in velocity.T)
        expected = synthetic.waves(np.stack(on(cells), axis=-1).reshape(-1, 2))[1].reshape(cells.shape)
        self.assertLess(np.abs(grid.vorticity(u, v, cells) - expected).max() / expected.max(), 5e-4)


if __name__ == "__main__":
    unittest.main()
