#pragma once

// The gradient of a velocity without divergence.

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "mesogen/fields/field_view.hpp"
#include "mesogen/mesh/kept_modes.hpp"

namespace mesogen::incompressible {

/// Elements of the gradient that are found: the last one on the diagonal follows from the others.
template <int Dim>
constexpr int gradient_elements = Dim* Dim - 1;

/// Modes of these elements, row by row, from those of the velocity.
template <int Dim>
void differentiate(const std::array<double, Dim>& k, const mesh::Complex* velocity, mesh::Complex* elements) {
  for (int c = 0; c < gradient_elements<Dim>; ++c) elements[c] = mesh::derivative(k[c % Dim], velocity[c / Dim]);
}

/// Puts the elements of a particle's gradient into the field, row by row, with the last one that follows from them.
template <int Dim, class Real>
void put_gradient(const FieldView<Real>& gradient, Index i, const Real* elements) {
  constexpr int count = gradient_elements<Dim>;
  Real trace = Real(0);
  for (int c = 0; c < count; ++c) {
    gradient(c, i) = elements[c];
    if (c % Dim == c / Dim) trace += elements[c];
  }
  gradient(count, i) = -trace;
}

/// Root of the mean square of the gradient of a velocity that is given by its modes, 1/s: added up in one order,
/// whatever the number of threads. `row_sums` is room for a number a row of modes.
template <int Dim>
double mean_gradient(const mesh::KeptModes<Dim>& kept, const std::array<std::vector<mesh::Complex>, Dim>& velocity,
                     std::vector<double>& row_sums) {
  const int rows = kept.grid().row_count();
  row_sums.assign(static_cast<std::size_t>(rows), 0.0);
#pragma omp parallel for schedule(static) if (rows * kept.in_row() >= mesh::parallel_threshold)
  for (int row = 0; row < rows; ++row) {
    double sum = 0.0;
    kept.for_each_in_row(row, [&](std::size_t n, const std::array<double, Dim>& k, int x) {
      const double square = mesh::KeptModes<Dim>::square(k);
      // Each stands for its conjugate too, which is not stored, but for those of x = 0.
      for (int d = 0; d < Dim; ++d) sum += (x == 0 ? 1.0 : 2.0) * square * std::norm(velocity[d][n]);
    });
    row_sums[static_cast<std::size_t>(row)] = sum;
  }
  double total = 0.0;
  for (const double sum : row_sums) total += sum;
  return std::sqrt(total);
}

}  // namespace mesogen::incompressible
