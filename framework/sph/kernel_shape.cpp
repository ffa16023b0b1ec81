#include "mesogen/sph/kernel_shape.hpp"

#include <cmath>
#include <numbers>

namespace mesogen::sph {

namespace {

/// t^n; std::pow takes ten times as long for a small whole number.
double raised(double t, int n) {
  double product = 1.0;
  for (; n > 0; --n) product *= t;
  return product;
}

}  // namespace

double KernelShape::support() const { return pieces.empty() ? 0.0 : pieces.front().knot; }

double KernelShape::value(double q) const {
  double total = 0.0;
  for (const auto& piece : pieces) {
    const double t = std::max(0.0, piece.knot - q);
    double p = raised(t, power);
    for (const double c : piece.coefficients) {
      total += c * p;
      p *= t;
    }
  }
  return total;
}

double KernelShape::derivative(double q) const {
  double total = 0.0;
  for (const auto& piece : pieces) {
    if (q >= piece.knot) continue;
    const double t = piece.knot - q;
    double p = raised(t, power - 1);
    int d = power;
    for (const double c : piece.coefficients) {
      total -= c * d++ * p;
      p *= t;
    }
  }
  return total;
}

double KernelShape::normalisation(int dimension) const {
  // The integral over a sphere of dimension D: surface(D) * int_0^k (k - q)^d q^(D-1) dq, the latter
  // k^(d+D) (D-1)! / ((d+1) ... (d+D)).
  const double surface = 2.0 * std::pow(std::numbers::pi, 0.5 * dimension) / std::tgamma(0.5 * dimension);
  double integral = 0.0;
  for (const auto& piece : pieces) {
    int d = power;
    for (const double c : piece.coefficients) {
      double term = raised(piece.knot, d + dimension);
      for (int m = 2; m < dimension; ++m) term *= m;
      for (int m = 1; m <= dimension; ++m) term /= d + m;
      integral += c * term;
      ++d;
    }
  }
  return 1.0 / (surface * integral);
}

std::string KernelShape::problem() const {
  if (pieces.empty()) return "it has no pieces";
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const auto& piece = pieces[k];
    if (!(piece.knot > 0.0) || !std::isfinite(piece.knot)) return "a knot is not a positive number";
    if (k > 0 && piece.knot >= pieces[k - 1].knot) return "its knots do not fall";
    if (piece.coefficients.empty()) return "a piece has no coefficients";
    if (piece.coefficients.size() != pieces.front().coefficients.size())
      return "its pieces differ in the number of coefficients";
    for (const double c : piece.coefficients)
      if (!std::isfinite(c)) return "a coefficient is not finite";
  }
  if (pieces.size() > 6 || pieces.front().coefficients.size() > 6) return "it has more than 6 pieces or 6 coefficients";
  if (power < 3) return "its lowest power is below 3, so its second derivative jumps at a knot";
  if (!(value(0.0) > 0.0)) return "it is not positive at q = 0";
  constexpr int samples = 200;
  for (int n = 1; n < samples; ++n) {
    const double q = support() * n / samples;
    if (derivative(q) > 1e-12 * value(0.0)) return "it rises with q near q = " + std::to_string(q);
  }
  if (std::abs(derivative(0.0)) > 1e-9 * value(0.0)) return "its slope at q = 0 is not zero";
  return {};
}

}  // namespace mesogen::sph
