#pragma once

#include <cmath>

namespace mesogen::mesh {

/// The cubic B-spline of particle-mesh methods (Hockney and Eastwood, Computer Simulation Using Particles, 1988): four
/// points per axis share a particle's value; the weights are smooth, add up to 1 and keep the first moment.
struct CubicSpline {
  static constexpr int points = 4;

  /// Weights of the four points, the first below the particle's cell; `fraction`: position in the cell, 0 to 1.
  static void weights(double fraction, double (&weight)[points]) {
    const double f = fraction;
    const double g = 1.0 - f;
    weight[0] = g * g * g / 6.0;
    weight[1] = (4.0 + f * f * (3.0 * f - 6.0)) / 6.0;
    weight[2] = (4.0 + g * g * (3.0 * g - 6.0)) / 6.0;
    weight[3] = f * f * f / 6.0;
  }

  /// Factor of a wave's amplitude when spread, and when interpolated: sinc^4(half wave number times mesh spacing).
  static double transform(double half_phase) {
    if (std::abs(half_phase) < 1e-8) return 1.0;
    const double sinc = std::sin(half_phase) / half_phase;
    return sinc * sinc * sinc * sinc;
  }
};

}  // namespace mesogen::mesh
