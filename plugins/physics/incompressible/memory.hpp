#pragma once

#include <algorithm>

#include "mesogen/mesh/pass_spectrum.hpp"
#include "velocity_gradient.hpp"

namespace mesogen::incompressible {

/// Approximate memory of a MeshFlow, in bytes: of its own modes, and of the mesh.
template <class Real, int Dim>
double mesh_flow_memory(const mesh::Grid<Dim>& grid, Index particles) {
  constexpr int evaluated = std::max(Dim + gradient_elements<Dim>, 2 * Dim + 2 + Dim);
  constexpr int modes = 3 * Dim + 2 * Dim + 1;
  return static_cast<double>(modes * grid.mode_count() * sizeof(mesh::Complex)) +
         mesh::PassSpectrum<Dim, Real>::bytes(grid, particles, Dim, evaluated);
}

}  // namespace mesogen::incompressible
