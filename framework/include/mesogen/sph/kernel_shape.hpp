#pragma once

#include <string>
#include <vector>

#include "mesogen/export.hpp"

namespace mesogen::sph {

/// A smoothing kernel as data, in the truncated power basis:
///
///     f(q) = sum over pieces of  sum over n of  coefficient[n] * (knot - q)_+^(power + n),   q = r / h
///
/// Every piecewise polynomial kernel in use has this form. The form is exact, has no branches, and is zero beyond the
/// support by itself, so a pair loop is right without a mask or a neighbour list. The framework normalises the kernel.
///
/// Quintic spline (Schoenberg 1946; Morris 1997): (3-q)^5 - 6 (2-q)^5 + 15 (1-q)^5. Wendland C2, C4, C6 (Wendland 1995;
/// Dehnen & Aly 2012): one knot, 2, with two, three, four powers.
struct MESOGEN_EXPORT KernelShape {
  struct Piece {
    double knot = 0.0;
    std::vector<double> coefficients;
  };

  std::vector<Piece> pieces;  ///< in order of falling knots; all have the same number of coefficients
  int power = 0;              ///< lowest power, the same for every piece

  /// Largest q with f(q) > 0, which is the first knot.
  [[nodiscard]] double support() const;
  /// f(q), not normalised.
  [[nodiscard]] double value(double q) const;
  /// f'(q), not normalised.
  [[nodiscard]] double derivative(double q) const;
  /// 1 / integral of f over all space of this dimension (1, 2 or 3), from the exact integrals of the powers.
  [[nodiscard]] double normalisation(int dimension) const;
  /// What is wrong with this shape, in words; empty if nothing. Needed: falling positive knots, equal numbers of
  /// coefficients, a power that leaves the second derivative continuous, a positive integral, no rise with q.
  [[nodiscard]] std::string problem() const;
};

}  // namespace mesogen::sph
