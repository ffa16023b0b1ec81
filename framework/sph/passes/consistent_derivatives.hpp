#pragma once

#include "mesogen/sph/pair_sum.hpp"
#include "mesogen/sph/small_matrix.hpp"
#include "sph/standard_passes.hpp"

namespace mesogen::sph {

/// Derivatives of `Count` scalars with a Laplacian that is exact for quadratic functions on any particles, in 2D.
///
/// A function with gradient G and second derivatives H is fitted to the differences f_j - f_i = G.d + H:dd/2,
/// d = r_j - r_i, by least squares with weights w = -V_j W'(r) / r (cf. A. M. Tartakovsky et al., Comput. Geosci. 20,
/// 807 (2016)). The weighted means of dd, ddd and dddd are alpha, T and F (T and F in powers of 1/h):
///
///     sum_j w d  (f_j - f_i) = alpha G + h/2 T:H
///     sum_j w dd (f_j - f_i) = h T.G + h^2/2 F:H
///
/// Without G, a 3 x 3 system S = F - T.B.T for H is left, B = alpha^-1. The gradient that is handed out is B times the
/// first sum, as with the plain Laplacian: exact for linear functions.
template <class Real, int Dim, int Count>
struct ConsistentDerivativePass {
  static_assert(Dim == 2, "the moments here are those of two dimensions");
  // Sums: the 3 second moments dd (xx, xy, yy), 4 third ones, 5 fourth ones, then for each scalar its d (2) and dd (3).
  enum Sum { second = 0, third = 3, fourth = 7, of_scalar = 12 };
  static constexpr int per_scalar = 5;
  static constexpr int sum_count = of_scalar + Count * per_scalar;
  Derivatives<Real, Dim> wanted;
  Real smoothing_length;

  struct Own {
    Real value[Count];
  };
  MESOGEN_HOST_DEVICE Own load(Index i) const {
    Own own{};
    for (int n = 0; n < Count; ++n) own.value[n] = wanted.source[n][i];
    return own;
  }

  template <class Pair, class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void pair(const Own& own, const Pair& p, Lane* sum) const {
    const Lane g = p.load(wanted.volume) * p.gradient();  // -w
    const Real scale = Real(-1) / smoothing_length;
    const Lane x = p.separation[0] * scale;  // d / h
    const Lane y = p.separation[1] * scale;
    const Lane wx = g * p.separation[0];  // w d
    const Lane wy = g * p.separation[1];
    const Lane wxx = Lane(Real(0)) - wx * p.separation[0];
    const Lane wxy = Lane(Real(0)) - wx * p.separation[1];
    const Lane wyy = Lane(Real(0)) - wy * p.separation[1];
    sum[second] = sum[second] + wxx;
    sum[second + 1] = sum[second + 1] + wxy;
    sum[second + 2] = sum[second + 2] + wyy;
    const Lane wxxx = wxx * x;
    const Lane wxxy = wxx * y;
    const Lane wxyy = wyy * x;
    const Lane wyyy = wyy * y;
    sum[third] = sum[third] + wxxx;
    sum[third + 1] = sum[third + 1] + wxxy;
    sum[third + 2] = sum[third + 2] + wxyy;
    sum[third + 3] = sum[third + 3] + wyyy;
    sum[fourth] = sum[fourth] + wxxx * x;
    sum[fourth + 1] = sum[fourth + 1] + wxxx * y;
    sum[fourth + 2] = sum[fourth + 2] + wxxy * y;
    sum[fourth + 3] = sum[fourth + 3] + wyyy * x;
    sum[fourth + 4] = sum[fourth + 4] + wyyy * y;
    exec::unroll<Count>([&](auto n) {
      constexpr int at = of_scalar + n * per_scalar;
      const Lane difference = p.load({wanted.source[n], 0}) - Lane(own.value[n]);
      sum[at] = sum[at] + wx * difference;
      sum[at + 1] = sum[at + 1] + wy * difference;
      sum[at + 2] = sum[at + 2] + wxx * difference;
      sum[at + 3] = sum[at + 3] + wxy * difference;
      sum[at + 4] = sum[at + 4] + wyy * difference;
    });
  }

  MESOGEN_HOST_DEVICE void finish(Index i, const Own&, const Real* sum) const {
    Real b[4];
    invert_symmetric<Real, 2>(sum + second, b);
    // Laplacian = of_second . (sums of dd) - of_first . (sums of d)
    Real of_first[2];
    Real of_second[3];
    weights(sum, b, of_first, of_second);
    const Real* s = sum + of_scalar;
    for (int n = 0; n < Count; ++n, s += per_scalar) {
      if (wanted.laplacian[n] != nullptr)
        wanted.laplacian[n][i] =
            of_second[0] * s[2] + of_second[1] * s[3] + of_second[2] * s[4] - (of_first[0] * s[0] + of_first[1] * s[1]);
      if (wanted.gradient[n][0] == nullptr) continue;
      wanted.gradient[n][0][i] = b[0] * s[0] + b[1] * s[1];
      wanted.gradient[n][1][i] = b[2] * s[0] + b[3] * s[1];
    }
    if (wanted.correction)
      for (int c = 0; c < 4; ++c) wanted.correction(c, i) = b[c];
  }

 private:
  MESOGEN_HOST_DEVICE void weights(const Real* sum, const Real* b, Real* of_first, Real* of_second) const {
    const Real* t = sum + third;
    const Real* f = sum + fourth;
    // T as rows xx, xy, yy; columns x, y. TB likewise.
    Real tb[3][2];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 2; ++c) tb[r][c] = t[r] * b[c] + t[r + 1] * b[2 + c];
    Real system[6];  // upper triangle of S
    for (int r = 0, n = 0; r < 3; ++r)
      for (int c = r; c < 3; ++c, ++n) system[n] = f[r + c] - (tb[r][0] * t[c] + tb[r][1] * t[c + 1]);
    Real inverse[9];
    invert_symmetric<Real, 3>(system, inverse);
    const Real per_length = Real(2) / (smoothing_length * smoothing_length);
    for (int r = 0; r < 3; ++r) of_second[r] = per_length * (inverse[3 * r] + inverse[3 * r + 2]);
    for (int c = 0; c < 2; ++c) {
      of_first[c] = Real(0);
      for (int r = 0; r < 3; ++r) of_first[c] += smoothing_length * of_second[r] * tb[r][c];
    }
  }
};

}  // namespace mesogen::sph
