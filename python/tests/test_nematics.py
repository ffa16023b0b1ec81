"""Director and defects."""

import unittest

import numpy as np
import synthetic  # noqa: F401  finds the package

from mesogen import grid, nematics


def with_defects(cells, defects):
    """Q of a director with the given (x, y, charge) and turned by `turn`: images of the box added up, so that it is
    nearly periodic; the charges must cancel."""
    x, y = np.meshgrid(cells.x, cells.y)
    angle = np.zeros(cells.shape)
    for place_x, place_y, charge in defects:
        for shift_x in range(-6, 7):
            for shift_y in range(-6, 7):
                across = x - place_x - shift_x * cells.box[0]
                angle += charge * np.arctan2(y - place_y - shift_y * cells.box[1], across)
    return np.cos(2 * angle), np.sin(2 * angle)


def alone(charge, turn, place=(0.03, 0.02)):
    """Q around one defect in the middle of a box; what the faces break is left to the caller."""
    cells = grid.Grid((4, 4), (40, 40))
    x, y = np.meshgrid(cells.x - 2 - place[0], cells.y - 2 - place[1])
    angle = charge * np.arctan2(y, x) + turn
    order = np.tanh(np.hypot(x, y) / 0.2)
    found = nematics.find_defects(order * np.cos(2 * angle), order * np.sin(2 * angle), cells)
    return found[np.hypot(found[:, 0] - 2, found[:, 1] - 2) < 1]


class DirectorOfQ(unittest.TestCase):
    def test_angle_and_order(self):
        angle = np.array([0.0, 0.3, -0.3, 1.5, -1.5, np.pi / 2])
        found = nematics.director(0.7 * np.cos(2 * angle), 0.7 * np.sin(2 * angle))
        np.testing.assert_allclose(found.angle, angle, atol=1e-14)
        np.testing.assert_allclose(found.order, 0.7)

    def test_vertical_director_has_one_angle(self):
        self.assertEqual(nematics.director(-1.0, -0.0).angle, np.pi / 2)
        self.assertEqual(nematics.director(-1.0, 0.0).angle, np.pi / 2)


class Defects(unittest.TestCase):
    def test_uniform_director_has_none(self):
        cells = grid.Grid((1, 1), (8, 8))
        self.assertEqual(nematics.find_defects(np.ones((8, 8)), np.zeros((8, 8)), cells).shape, (0, 4))

    def test_prescribed_defects_are_found_within_a_cell(self):
        cells = grid.Grid((10, 10), (80, 80))
        # Zero dipole moment: then the sum over images is periodic.
        given = np.array([[2.03, 2.51, 0.5], [7.48, 7.52, 0.5], [7.53, 2.02, -0.5], [1.98, 8.01, -0.5]])
        found = nematics.find_defects(*with_defects(cells, given), cells)
        inside = ((found[:, :2] > 0.5) & (found[:, :2] < 9.5)).all(axis=1)
        self.assertEqual(found[:, 2].sum(), 0)
        for x, y, charge in given:
            near = np.hypot(found[inside, 0] - x, found[inside, 1] - y) < 10 / 80
            self.assertEqual(found[inside][near, 2].tolist(), [charge])

    def test_core_is_placed_between_cells(self):
        found = alone(0.5, 0.0)
        np.testing.assert_allclose(found[:, :2], [[2.03, 2.02]], atol=0.005)

    def test_tail_of_plus_half_turns_twice_as_far_as_the_director(self):
        for turn in (0.0, 0.4, -0.7, 1.2):
            found = alone(0.5, turn)
            self.assertEqual(found[:, 2].tolist(), [0.5])
            self.assertLess(abs(np.angle(np.exp(1j * (found[0, 3] - 2 * turn)))), 0.03)

    def test_leg_of_minus_half(self):
        for turn in (0.0, 0.4, -0.7, 1.2):
            found = alone(-0.5, turn)
            self.assertEqual(found[:, 2].tolist(), [-0.5])
            self.assertLess(abs(np.angle(np.exp(3j * (found[0, 3] - 2 * turn / 3)))), 0.09)
            self.assertLessEqual(abs(found[0, 3]), np.pi / 3 + 1e-12)

    def test_director_points_along_the_orientation(self):
        for charge in (0.5, -0.5):
            turn = 0.35
            orientation = alone(charge, turn)[0, 3]
            director = charge * orientation + turn
            self.assertLess(abs(np.sin(director - orientation)), 0.03)


if __name__ == "__main__":
    unittest.main()
