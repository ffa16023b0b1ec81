#pragma once

#include "mesogen/exec/lanes.hpp"
#include "mesogen/exec/unroll.hpp"
#include "mesogen/sph/small_matrix.hpp"

/// What turns differences of a function between a particle and its neighbours into derivatives. A fit adds up moments
/// of the neighbours' places, solves for its weights, and gives each pair its share:
///
///     gradient_i f = B_i . sum_j s_ij r_ij (f_j - f_i),   lap_i f = sum_j laplacian(pair ij, s_ij r_ij) (f_j - f_i),
///
/// s_ij = V_j W'(r_ij) / r_ij. Weights are numbers in a row, the correction B_i first; they are solved for as many
/// particles at a time as a pack has lanes. Trivially copyable.
namespace mesogen::sph {

/// A pair, or a pack of pairs, as fits see it.
template <class Lane, int Dim>
struct WeighedPair {
  Lane slope;            ///< s_ij, 1/m^2, negative
  Lane separation[Dim];  ///< r_i - r_j, m
};

/// Solves for nothing but the correction of the gradient; see Derivatives.
template <class Real, int Dim>
struct PlainFit {
  static constexpr bool gives_laplacian = true;
  static constexpr int sum_count = symmetric_components<Dim>;

  /// `sum` grows by - s_ij r_ij (x) r_ij, upper triangle.
  template <class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void add(const WeighedPair<Lane, Dim>& p, Lane* sum) const {
    exec::unroll<Dim>([&](auto a) __attribute__((always_inline)) {
      const Lane weight = p.slope * p.separation[a];
      exec::unroll<Dim - a>([&](auto offset) __attribute__((always_inline)) {
        constexpr int n = symmetric_index<Dim>(a, a + offset);
        sum[n] = sum[n] - weight * p.separation[a + offset];
      });
    });
  }

  enum Weight { correction = 0, scale = Dim * Dim, weight_count };

  template <class Number>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void solve(const Number* sum, Number* weight) const {
    invert_symmetric<Real, Dim>(sum, weight + correction);
    Number trace(Real(2));
    for (int d = 0; d < Dim; ++d) trace = trace + sum[symmetric_index<Dim>(d, d)];
    weight[scale] = Number(Real(-2 * (2 + Dim))) / trace;
  }

  template <class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE Lane laplacian(const WeighedPair<Lane, Dim>& p, const Lane*,
                                                            const Real* weight) const {
    return p.slope * weight[scale];
  }
};

/// The gradient alone.
template <class Real, int Dim>
struct GradientFit : PlainFit<Real, Dim> {
  static constexpr bool gives_laplacian = false;
};

/// A Laplacian that is exact for quadratic functions on any particles, in 2D.
///
/// A function with gradient G and second derivatives H is fitted to the differences f_j - f_i = G.d + H:dd/2,
/// d = r_j - r_i, by least squares with weights w = -s_ij (cf. A. M. Tartakovsky et al., Comput. Geosci. 20, 807
/// (2016)). The weighted means of dd, ddd and dddd are alpha, T and F (T and F in powers of 1/h):
///
///     sum_j w d  (f_j - f_i) = alpha G + h/2 T:H
///     sum_j w dd (f_j - f_i) = h T.G + h^2/2 F:H
///
/// Without G, a 3 x 3 system S = F - T.B.T for H is left, B = alpha^-1. The gradient that is handed out is B times the
/// first sum, as with the plain Laplacian: exact for linear functions.
template <class Real>
struct ConsistentFit {
  static constexpr bool gives_laplacian = true;
  // The 3 second moments dd (xx, xy, yy), 4 third ones, 5 fourth ones; of -d and -w, so with the other sign.
  enum Sum { second = 0, third = 3, fourth = 7, sum_count = 12 };
  Real smoothing_length;

  template <class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void add(const WeighedPair<Lane, 2>& p, Lane* sum) const {
    const Lane& x = p.separation[0];
    const Lane& y = p.separation[1];
    // As many as possible are one operation: a product and a sum.
    const Lane xx = x * x;
    const Lane xy = x * y;
    const Lane yy = y * y;
    const Lane sxx = p.slope * xx;
    const Lane syy = p.slope * yy;
    sum[second] = sum[second] + sxx;
    sum[second + 1] = sum[second + 1] + p.slope * xy;
    sum[second + 2] = sum[second + 2] + syy;
    sum[third] = sum[third] + sxx * x;
    sum[third + 1] = sum[third + 1] + sxx * y;
    sum[third + 2] = sum[third + 2] + syy * x;
    sum[third + 3] = sum[third + 3] + syy * y;
    sum[fourth] = sum[fourth] + sxx * xx;
    sum[fourth + 1] = sum[fourth + 1] + sxx * xy;
    sum[fourth + 2] = sum[fourth + 2] + sxx * yy;
    sum[fourth + 3] = sum[fourth + 3] + syy * xy;
    sum[fourth + 4] = sum[fourth + 4] + syy * yy;
  }

  // The last two: of the sums of s r, and of s rr.
  enum Weight { correction = 0, of_first = 4, of_second = 6, weight_count = 9 };

  template <class Number>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void solve(const Number* sum, Number* weight) const {
    const Real per_length = Real(1) / smoothing_length;
    Number alpha[3];
    Number t[4];
    Number f[5];
    for (int n = 0; n < 3; ++n) alpha[n] = sum[second + n] * Real(-1);
    for (int n = 0; n < 4; ++n) t[n] = sum[third + n] * per_length;
    for (int n = 0; n < 5; ++n) f[n] = sum[fourth + n] * (-per_length * per_length);
    Number* const b = weight + correction;
    invert_symmetric<Real, 2>(alpha, b);
    // T as rows xx, xy, yy; columns x, y. TB likewise.
    Number tb[3][2];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 2; ++c) tb[r][c] = t[r] * b[c] + t[r + 1] * b[2 + c];
    Number system[6];  // upper triangle of S
    for (int r = 0, n = 0; r < 3; ++r)
      for (int c = r; c < 3; ++c, ++n) system[n] = f[r + c] - (tb[r][0] * t[c] + tb[r][1] * t[c + 1]);
    Number inverse[9];
    invert_symmetric<Real, 3>(system, inverse);
    // lap f = - of_second . (sums of s rr (f_j - f_i)) - of_first . (sums of s r (f_j - f_i))
    for (int r = 0; r < 3; ++r)
      weight[of_second + r] = (inverse[3 * r] + inverse[3 * r + 2]) * (Real(-2) * per_length * per_length);
    for (int c = 0; c < 2; ++c)
      weight[of_first + c] =
          (weight[of_second] * tb[0][c] + weight[of_second + 1] * tb[1][c] + weight[of_second + 2] * tb[2][c]) *
          smoothing_length;
  }

  template <class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE Lane laplacian(const WeighedPair<Lane, 2>& p, const Lane* gradient,
                                                            const Real* weight) const {
    const Lane& x = p.separation[0];
    const Lane& y = p.separation[1];
    const Lane along_x = x * weight[of_second] + (y * weight[of_second + 1] + Lane(weight[of_first]));
    const Lane along_y = y * weight[of_second + 2] + Lane(weight[of_first + 1]);
    return along_x * gradient[0] + along_y * gradient[1];
  }
};

}  // namespace mesogen::sph
