#pragma once

#include "mesogen/exec/lanes.hpp"

/// Linear algebra of one particle or of a pack of particles: symmetric Dim x Dim matrices, stored as their upper
/// triangle.
namespace mesogen::sph {

template <int Dim>
inline constexpr int symmetric_components = Dim*(Dim + 1) / 2;

/// Index of (row, column) in the upper triangle, stored row by row.
template <int Dim>
MESOGEN_HOST_DEVICE constexpr int symmetric_index(int row, int column) {
  const int r = row < column ? row : column;
  const int c = row < column ? column : row;
  return r * Dim - r * (r - 1) / 2 + c - r;
}

namespace detail {

/// Returns 1 / determinant, or zero if the matrix is singular. `unit` becomes 1 if it is singular, else zero.
template <class Number, class Real>
[[gnu::always_inline]] MESOGEN_HOST_DEVICE inline Number inverse_determinant(const Number& determinant, Real,
                                                                             Number& unit) {
  const Number size = exec::positive_part(determinant) + exec::positive_part(Number(Real(0)) - determinant);
  const Number limit(Real(1e-6));
  const Number one(Real(1));
  unit = one - exec::where_less(limit, size, one);
  return exec::where_less(limit, size, one / determinant);
}

}  // namespace detail

/// Sets inverse = matrix^-1, Dim x Dim, row by row; the identity if the matrix is singular. `Number` is Real or a pack
/// of Reals.
template <class Real, int Dim, class Number>
MESOGEN_HOST_DEVICE void invert_symmetric(const Number* upper, Number* inverse) {
  Number unit;
  if constexpr (symmetric_components<Dim> == 3) {
    const Number& a = upper[0];
    const Number& b = upper[1];
    const Number& c = upper[2];
    const Number scale = detail::inverse_determinant(a * c - b * b, Real(), unit);
    inverse[0] = c * scale + unit;
    inverse[1] = inverse[2] = Number(Real(0)) - b * scale;
    inverse[3] = a * scale + unit;
  } else {
    static_assert(symmetric_components<Dim> == 6);
    const Number &a = upper[0], &b = upper[1], &c = upper[2], &d = upper[3], &e = upper[4], &f = upper[5];
    const Number minor_a = d * f - e * e;
    const Number minor_b = c * e - b * f;
    const Number minor_c = b * e - c * d;
    const Number scale = detail::inverse_determinant(a * minor_a + b * minor_b + c * minor_c, Real(), unit);
    inverse[0] = minor_a * scale + unit;
    inverse[1] = inverse[3] = minor_b * scale;
    inverse[2] = inverse[6] = minor_c * scale;
    inverse[4] = (a * f - c * c) * scale + unit;
    inverse[5] = inverse[7] = (b * c - a * e) * scale;
    inverse[8] = (a * d - b * b) * scale + unit;
  }
}

}  // namespace mesogen::sph
