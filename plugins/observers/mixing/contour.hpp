#pragma once

#include <array>
#include <vector>

#include "mesogen/plugin/scene.hpp"

namespace mesogen {

/// Length of the line between two colours in the plane, m: where the colour, averaged onto a regular grid, is 1/2.
///
/// `points`: coordinates in the box, m; `colour`: 0 to 1; both by particle id. `mesh_spacing`: distance of the nodes of
/// the grid, in particle spacings, about: a whole number of them fits an edge of the box. Between walls, the outermost
/// nodes lie on the walls, and a line ends there.
///
/// The value at a node is the mean of the particles about it, C(x) = sum_j W(x - x_j) C_j / sum_j W(x - x_j) (Shepard
/// 1968), W the cubic B-spline of the grid. In each square of four nodes the line is a straight piece from edge to
/// edge, each end where C, linear along its edge, is 1/2 (marching squares; Lorensen & Cline, SIGGRAPH 1987); if all
/// four are crossed, the mean of the nodes tells which of them are joined. Squares with a node that has no particle
/// about it are left out.
double contour_length(const Scene& scene, const std::vector<std::array<double, 2>>& points,
                      const std::vector<double>& colour, double mesh_spacing);

}  // namespace mesogen
