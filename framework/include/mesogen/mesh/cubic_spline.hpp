#pragma once

#include <cmath>

namespace mesogen::mesh {

/// The cubic B-spline of particle-mesh methods (Hockney and Eastwood, Computer Simulation Using Particles, 1988): a
/// particle and four points a side share weights that add up to 1, are smooth, and also carry the first moment.
struct CubicSpline {
  static constexpr int points = 4;

  /// Weights of the four points from the one below the particle's cell on; `fraction` is where in its cell it stands.
  static void weights(double fraction, double (&weight)[points]) {
    const double f = fraction;
    const double g = 1.0 - f;
    weight[0] = g * g * g / 6.0;
    weight[1] = (4.0 + f * f * (3.0 * f - 6.0)) / 6.0;
    weight[2] = (4.0 + g * g * (3.0 * g - 6.0)) / 6.0;
    weight[3] = f * f * f / 6.0;
  }

  /// What spreading leaves of a wave, and likewise interpolating it: sinc^4 of half the wave number times the spacing.
  static double transform(double half_phase) {
    if (std::abs(half_phase) < 1e-8) return 1.0;
    const double sinc = std::sin(half_phase) / half_phase;
    return sinc * sinc * sinc * sinc;
  }
};

}  // namespace mesogen::mesh
