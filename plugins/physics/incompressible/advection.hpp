#pragma once

#include <array>

#include "mesogen/mesh/mode_transform.hpp"

namespace mesogen::incompressible {

/// Subtracts div(u u) from a force, by products at the points of the mesh. velocity(n, numbers) must write the n-th
/// modes of u.
template <int Dim, class Real, class Velocity>
void subtract_advection(mesh::ModeTransform<Dim, Real>& transform, const Velocity& velocity,
                        const std::array<mesh::Complex*, Dim>& force) {
  constexpr int products = Dim * (Dim + 1) / 2;
  using WaveVector = std::array<double, Dim>;
  auto& points = transform.points(products);
  transform.template to_points<Dim>(
      [&](std::size_t n, const WaveVector&, mesh::Complex* numbers) { velocity(n, numbers); });
  const int rows = points.row_count();
  const int columns = transform.kept().grid().points[0];
#pragma omp parallel for schedule(static) if (rows * columns >= mesh::parallel_threshold)
  for (int row = 0; row < rows; ++row) {
    Real* at[products];
    for (int c = 0; c < products; ++c) at[c] = points.row(c, row);
    for (int x = 0; x < columns; ++x) {
      Real u[Dim];
      for (int d = 0; d < Dim; ++d) u[d] = at[d][x];
      int c = 0;
      for (int a = 0; a < Dim; ++a)
        for (int b = a; b < Dim; ++b) at[c++][x] = u[a] * u[b];
    }
  }
  transform.template to_modes<products>([&](std::size_t n, const WaveVector& k, const mesh::Complex* flux) {
    int c = 0;
    for (int a = 0; a < Dim; ++a) {
      for (int b = a; b < Dim; ++b, ++c) {
        force[a][n] -= mesh::derivative(k[b], flux[c]);
        if (a != b) force[b][n] -= mesh::derivative(k[a], flux[c]);
      }
    }
  });
}

}  // namespace mesogen::incompressible
