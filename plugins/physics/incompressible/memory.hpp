#pragma once

#include "velocity_gradient.hpp"

namespace mesogen::incompressible {

/// What a MeshFlow takes, bytes: modes (complex, half as many as points), fields on the mesh, particles on it.
template <int Dim>
double mesh_flow_memory(const mesh::Grid<Dim>& grid, Index particles) {
  const auto points = static_cast<double>(grid.point_count());
  constexpr int gradients = gradient_elements<Dim>;
  constexpr double modes = 3 * Dim + 2 * Dim + (gradients + Dim + 1) + Dim + 1;
  constexpr double fields = 1 + (gradients + Dim + 1) + 2 * (Dim + 1) + (gradients + Dim + 1) + 0.5;
  return 8.0 * points * (modes + fields) + static_cast<double>(particles) * (28.0 + 40.0 * Dim);
}

}  // namespace mesogen::incompressible
