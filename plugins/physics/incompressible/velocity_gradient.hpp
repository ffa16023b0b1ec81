#pragma once

// The gradient of a velocity without divergence.

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "mesogen/fields/field_view.hpp"
#include "mesogen/mesh/particle_spectrum.hpp"

namespace mesogen::incompressible {

/// Elements of the gradient that are found: the last one on the diagonal follows from the others.
template <int Dim>
constexpr int gradient_elements = Dim* Dim - 1;

/// Puts the elements of a particle's gradient into the field, row by row, with the last one that follows from them.
template <int Dim, class Real>
void put_gradient(const FieldView<Real>& gradient, Index i, const double* elements) {
  constexpr int count = gradient_elements<Dim>;
  double trace = 0.0;
  for (int c = 0; c < count; ++c) {
    gradient(c, i) = Real(elements[c]);
    if (c % Dim == c / Dim) trace += elements[c];
  }
  gradient(count, i) = Real(-trace);
}

/// Root of the mean square of the gradient of a velocity that is given by its modes, 1/s: added up in one order,
/// whatever the number of threads. `row_sums` is room for a number a row of modes.
template <int Dim>
double mean_gradient(const mesh::Grid<Dim>& grid, const std::array<std::vector<mesh::Complex>, Dim>& velocity,
                     std::vector<double>& row_sums) {
  const int in_row = grid.modes_in_row();
  row_sums.assign(static_cast<std::size_t>(grid.row_count()), 0.0);
#pragma omp parallel for schedule(static) if (grid.mode_count() >= mesh::parallel_threshold)
  for (int row = 0; row < grid.row_count(); ++row) {
    std::array<int, Dim> at{};
    grid.row_coordinates(row, at);
    double across = 0.0;
    for (int d = 1; d < Dim; ++d) across += std::pow(grid.wave_number(d, at[d]), 2);
    double sum = 0.0;
    for (int n = 0; n < in_row; ++n) {
      const double square = across + std::pow(grid.wave_number(0, n), 2);
      const auto mode = static_cast<std::size_t>(row) * static_cast<std::size_t>(in_row) + static_cast<std::size_t>(n);
      // Each stands for its conjugate too, which is not stored, but for those of n = 0.
      for (int d = 0; d < Dim; ++d) sum += (n == 0 ? 1.0 : 2.0) * square * std::norm(velocity[d][mode]);
    }
    row_sums[static_cast<std::size_t>(row)] = sum;
  }
  double total = 0.0;
  for (const double sum : row_sums) total += sum;
  return std::sqrt(total);
}

}  // namespace mesogen::incompressible
