#pragma once

#include <array>
#include <vector>

#include "mesogen/mesh/particle_mesh.hpp"
#include "mesogen/plugin/scene.hpp"

namespace mesogen {

/// The line between two colours in the plane: where the colour, averaged onto a regular grid, is 1/2.
///
/// The value at a node is the mean of the particles about it, C(x) = sum_j W(x - x_j) C_j / sum_j W(x - x_j) (Shepard
/// 1968), W the cubic B-spline of the grid. In each square of four nodes the line is a straight piece from edge to
/// edge, each end where C, linear along its edge, is 1/2 (marching squares; Lorensen & Cline, SIGGRAPH 1987); if all
/// four are crossed, the mean of the nodes tells which of them are joined. Squares with a node that has no particle
/// about it are left out.
class ColourLine {
 public:
  /// `mesh_spacing`: distance of the nodes of the grid, in particle spacings, about: a whole number of them fits an
  /// edge of the box. Between walls, the outermost nodes lie on the walls, and a line ends there.
  ColourLine(const Scene& scene, double mesh_spacing);

  /// Returns the length of the line, m. `position`: coordinates in the box, m, by axis; `colour`: 0 to 1; both by
  /// particle, in any order.
  double length(const std::vector<std::vector<double>>& position, const std::vector<double>& colour);

 private:
  void average(const std::vector<std::vector<double>>& position, const std::vector<double>& colour);
  [[nodiscard]] double length_in_row(int row) const;

  std::array<int, 2> squares_{};   // along each axis
  std::array<double, 2> width_{};  // of one, m
  mesh::ParticleMesh<2> mesh_;
  // At each point of the mesh: the weight of the particles about it, and their mean colour, NaN without particles.
  mesh::FieldsOnGrid<double> means_;
};

}  // namespace mesogen
