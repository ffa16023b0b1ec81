#pragma once

#include "mesogen/exec/for_each.hpp"
#include "mesogen/sph/pair_sum.hpp"

namespace mesogen::incompressible {

/// Moves particles apart that stand close together, nearer than the points of the mesh: the mesh does not see them, but
/// sums over neighbours do. As a velocity (after Shadloo et al. 2011, Ozbulut et al. 2017):
///
///   rate sum_j ((dx / r_ij)^3 - (dx / R)^3) r_ij,   rate = strength max(|grad u|, its mean),
///
/// with dx the spacing of the particles and R the radius of the support, where the sum ends: without a jump, since
/// neighbours on a lattice may stand just there, and rounding would say which of them count. The mean counts where a
/// pair has come to lie in a quiet place.
template <class Real, int Dim>
struct PairShift {
  static constexpr int sum_count = Dim;

  FieldView<const Real> velocity_gradient;
  FieldView<Real> shift;
  Real strength;
  Real mean_gradient;  // root mean square, 1/s
  Real fastest_rate;   // 1/s
  Real fastest;        // m/s
  Real spacing;        // m
  Real at_support;     // (dx / R)^3

  struct Own {};
  MESOGEN_HOST_DEVICE Own load(Index) const { return {}; }

  template <class Pair, class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void pair(const Own&, const Pair& p, Lane* sum) const {
    const Lane inverse = p.inside(p.inverse_distance * spacing);
    const Lane cube = inverse * inverse * inverse;
    const Lane push = p.inside(cube - at_support);
    exec::unroll<Dim>([&](auto d) { sum[d] = sum[d] + push * p.separation[d]; });
  }

  MESOGEN_HOST_DEVICE void finish(Index i, const Own&, const Real* sum) const {
    Real square = Real(0);
    for (int c = 0; c < Dim * Dim; ++c) square += velocity_gradient(c, i) * velocity_gradient(c, i);
    const Real local = exec::square_root(square);
    Real rate = strength * (local > mean_gradient ? local : mean_gradient);
    if (rate > fastest_rate) rate = fastest_rate;
    Real length = Real(0);
    for (int d = 0; d < Dim; ++d) length += sum[d] * sum[d];
    length = exec::square_root(length);
    if (rate * length > fastest) rate = fastest / length;
    for (int d = 0; d < Dim; ++d) shift(d, i) += rate * sum[d];
  }
};

}  // namespace mesogen::incompressible
