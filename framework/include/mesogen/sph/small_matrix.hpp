#pragma once

#include "mesogen/export.hpp"

/// The little linear algebra of a particle: symmetric Dim x Dim matrices from their upper triangle.
namespace mesogen::sph {

template <int Dim>
inline constexpr int symmetric_components = Dim*(Dim + 1) / 2;

/// Place of (row, column) in the upper triangle, row by row.
template <int Dim>
MESOGEN_HOST_DEVICE constexpr int symmetric_index(int row, int column) {
  const int r = row < column ? row : column;
  const int c = row < column ? column : row;
  return r * Dim - r * (r - 1) / 2 + c - r;
}

/// inverse = matrix^-1, both Dim x Dim row by row; the identity where the matrix is singular.
template <class Real, int Dim>
MESOGEN_HOST_DEVICE void invert_symmetric(const Real* upper, Real* inverse) {
  if constexpr (Dim == 2) {
    const Real a = upper[0];
    const Real b = upper[1];
    const Real c = upper[2];
    const Real determinant = a * c - b * b;
    const bool singular = !(determinant > Real(1e-6) || determinant < Real(-1e-6));
    const Real scale = singular ? Real(0) : Real(1) / determinant;
    inverse[0] = singular ? Real(1) : c * scale;
    inverse[1] = inverse[2] = -b * scale;
    inverse[3] = singular ? Real(1) : a * scale;
  } else {
    static_assert(Dim == 3);
    const Real a = upper[0], b = upper[1], c = upper[2], d = upper[3], e = upper[4], f = upper[5];
    const Real minor_a = d * f - e * e;
    const Real minor_b = c * e - b * f;
    const Real minor_c = b * e - c * d;
    const Real determinant = a * minor_a + b * minor_b + c * minor_c;
    const bool singular = !(determinant > Real(1e-6) || determinant < Real(-1e-6));
    const Real scale = singular ? Real(0) : Real(1) / determinant;
    inverse[0] = singular ? Real(1) : minor_a * scale;
    inverse[1] = inverse[3] = minor_b * scale;
    inverse[2] = inverse[6] = minor_c * scale;
    inverse[4] = singular ? Real(1) : (a * f - c * c) * scale;
    inverse[5] = inverse[7] = (b * c - a * e) * scale;
    inverse[8] = singular ? Real(1) : (a * d - b * b) * scale;
  }
}

}  // namespace mesogen::sph
