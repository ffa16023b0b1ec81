#pragma once

#include <array>

#include "mesogen/mesh/kept_modes.hpp"

namespace mesogen::incompressible {

/// u_a u_b at a point, a <= b, row by row.
template <class Real, int Dim>
struct Products {
  static constexpr int count = Dim * (Dim + 1) / 2;

  MESOGEN_HOST_DEVICE void operator()(const Real* u, Real* products) const {
    int c = 0;
    for (int a = 0; a < Dim; ++a)
      for (int b = a; b < Dim; ++b) products[c++] = u[a] * u[b];
  }
};

/// Subtracts from a force the divergence of such products.
template <int Dim>
struct SubtractDivergence {
  std::array<mesh::Complex*, Dim> force;

  MESOGEN_HOST_DEVICE void operator()(std::size_t n, const std::array<double, Dim>& k,
                                      const mesh::Complex* flux) const {
    int c = 0;
    for (int a = 0; a < Dim; ++a) {
      for (int b = a; b < Dim; ++b, ++c) {
        force[a][n] -= mesh::derivative(k[b], flux[c]);
        if (a != b) force[b][n] -= mesh::derivative(k[a], flux[c]);
      }
    }
  }
};

/// Subtracts div(u u) from a force, by products at the points of the mesh. velocity(n, k, numbers) must write the n-th
/// modes of u. `transform`: as of mesh::PassSpectrum::with_transform.
template <class Real, int Dim, class Transform, class Velocity>
void subtract_advection(Transform& transform, const Velocity& velocity, const std::array<mesh::Complex*, Dim>& force) {
  constexpr int products = Products<Real, Dim>::count;
  transform.hold_points(products);
  transform.template to_points<Dim>(velocity);
  transform.template change_points<Dim, products>(Products<Real, Dim>{});
  transform.template to_modes<products>(SubtractDivergence<Dim>{force});
}

}  // namespace mesogen::incompressible
