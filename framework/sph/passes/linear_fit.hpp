#pragma once

#include "mesogen/sph/small_matrix.hpp"

/// A linear function fitted to scattered values by least squares.
namespace mesogen::sph {

/// Solves A x = b for a symmetric matrix (upper triangle); false where a pivot is below this part of the trace.
template <int Dim>
MESOGEN_HOST_DEVICE bool solve(const double* upper, const double (&b)[Dim], double degenerate, double (&x)[Dim]) {
  double least = 0.0;
  for (int d = 0; d < Dim; ++d) least += degenerate * upper[symmetric_index<Dim>(d, d)];
  double lower[Dim][Dim];  // A = L D L^T
  double pivot[Dim];
  for (int c = 0; c < Dim; ++c) {
    pivot[c] = upper[symmetric_index<Dim>(c, c)];
    for (int k = 0; k < c; ++k) pivot[c] -= lower[c][k] * lower[c][k] * pivot[k];
    if (!(pivot[c] > least)) return false;
    for (int r = c + 1; r < Dim; ++r) {
      lower[r][c] = upper[symmetric_index<Dim>(r, c)];
      for (int k = 0; k < c; ++k) lower[r][c] -= lower[r][k] * lower[c][k] * pivot[k];
      lower[r][c] /= pivot[c];
    }
  }
  for (int r = 0; r < Dim; ++r) {
    x[r] = b[r];
    for (int k = 0; k < r; ++k) x[r] -= lower[r][k] * x[k];
  }
  for (int r = Dim - 1; r >= 0; --r) {
    x[r] /= pivot[r];
    for (int k = r + 1; k < Dim; ++k) x[r] -= lower[k][r] * x[k];
  }
  return true;
}

/// A linear function of the way d from the point to a particle, in smoothing lengths: weight = W (constant + slope .
/// d).
template <int Dim>
struct Linear {
  double constant = 0.0;
  double slope[Dim] = {};
};

/// From the moments of the particles around a point: sum of W, of W d, of W dd (upper triangle). `degenerate`:
/// particles whose spread across a line is below this part of the whole lie on it.
template <int Dim>
MESOGEN_HOST_DEVICE Linear<Dim> fit_linear(const double* moment, double degenerate) {
  Linear<Dim> weight;
  const double sum = moment[0];
  if (!(sum > 0.0)) return weight;
  weight.constant = 1.0 / sum;
  double centre[Dim];
  for (int d = 0; d < Dim; ++d) centre[d] = moment[1 + d] / sum;
  double spread[symmetric_components<Dim>];  // of the particles about their centre
  for (int a = 0; a < Dim; ++a)
    for (int b = a; b < Dim; ++b) {
      const int n = symmetric_index<Dim>(a, b);
      spread[n] = moment[1 + Dim + n] - sum * centre[a] * centre[b];
    }
  double slope[Dim];
  if (!solve<Dim>(spread, centre, degenerate, slope)) return weight;
  for (int d = 0; d < Dim; ++d) {
    weight.slope[d] = -slope[d];
    weight.constant += slope[d] * centre[d];
  }
  return weight;
}

}  // namespace mesogen::sph
