#pragma once

#include <cmath>
#include <complex>

namespace mesogen::test {

using Complex = std::complex<double>;  // a vector of the plane

inline constexpr double disc = 0.5;   // R, m
inline constexpr double speed = 1.0;  // alpha R / (4 eta), that of a +1/2 at its centre, m/s

/// The Stokes flow of one defect under the stress alpha (nn - 1/2) in a disc of radius R, in the frame of the defect:
/// Giomi, Bowick, Mishra, Sknepnek & Marchetti, Phil. Trans. R. Soc. A 372, 20130365 (2014). With
/// z = x + iy = r e^(if),
///
///     +1/2:  u + iv = alpha / (12 eta) [3 (R - r) + r e^(2if)],   p = alpha cos f / 2
///     -1/2:  u + iv = alpha r / (12 eta R) [(3 r / 4 - R) e^(-2if) - R/5 e^(4if)],   p = -alpha cos(3f) / 6
///
/// with signs such that div u = 0 and eta lap u + alpha div Q = grad p; a test checks it.
inline Complex flow(double charge, Complex z) {
  const double r = std::abs(z);
  const double f = std::arg(z);
  if (charge > 0.0) return speed / (3.0 * disc) * (3.0 * (disc - r) + r * std::polar(1.0, 2.0 * f));
  return speed * r / (3.0 * disc * disc) *
         ((0.75 * r - disc) * std::polar(1.0, -2.0 * f) - 0.2 * disc * std::polar(1.0, 4.0 * f));
}

/// Its vorticity: alpha sin f / (2 eta) and -alpha sin(3f) / (6 eta).
inline double vorticity(double charge, Complex z) {
  const double f = std::arg(z);
  return charge > 0.0 ? 2.0 * speed / disc * std::sin(f) : -2.0 / 3.0 * speed / disc * std::sin(3.0 * f);
}

}  // namespace mesogen::test
