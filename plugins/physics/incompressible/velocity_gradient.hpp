#pragma once

// The gradient of a velocity without divergence.

#include <array>
#include <cmath>
#include <cstddef>

#include "mesogen/fields/field_view.hpp"
#include "mesogen/mesh/mode_loop.hpp"

namespace mesogen::incompressible {

/// Elements of the gradient that are found: the last one on the diagonal follows from the others.
template <int Dim>
constexpr int gradient_elements = Dim* Dim - 1;

/// Modes of these elements, row by row, from those of the velocity.
template <int Dim>
MESOGEN_HOST_DEVICE void differentiate(const std::array<double, Dim>& k, const mesh::Complex* velocity,
                                       mesh::Complex* elements) {
  for (int c = 0; c < gradient_elements<Dim>; ++c) elements[c] = mesh::derivative(k[c % Dim], velocity[c / Dim]);
}

/// Puts the elements of a particle's gradient into the field, row by row, with the last one that follows from them.
template <int Dim, class Real>
MESOGEN_HOST_DEVICE void put_gradient(const FieldView<Real>& gradient, Index i, const Real* elements) {
  constexpr int count = gradient_elements<Dim>;
  Real trace = Real(0);
  for (int c = 0; c < count; ++c) {
    gradient(c, i) = elements[c];
    if (c % Dim == c / Dim) trace += elements[c];
  }
  gradient(count, i) = -trace;
}

/// Of the square of a velocity's gradient, the part of a mode.
template <int Dim>
struct SquareOfGradient {
  std::array<const mesh::Complex*, Dim> velocity;

  MESOGEN_HOST_DEVICE void operator()(std::size_t n, const std::array<double, Dim>& k, int x, double& sum) const {
    const double square = mesh::KeptModes<Dim>::square(k);
    // Each stands for its conjugate too, which is not stored, but for those of x = 0.
    for (int d = 0; d < Dim; ++d) sum += (x == 0 ? 1.0 : 2.0) * square * norm(velocity[d][n]);
  }
};

/// Root of the mean square of the gradient of a velocity that is given by its modes, 1/s.
template <int Dim>
double mean_gradient(mesh::ModeLoop<Dim>& modes, const std::array<const mesh::Complex*, Dim>& velocity) {
  return std::sqrt(modes.sum(SquareOfGradient<Dim>{velocity}));
}

}  // namespace mesogen::incompressible
