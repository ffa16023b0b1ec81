#pragma once

#include <array>
#include <cstddef>

#include "mesogen/mesh/four_points.hpp"

namespace mesogen::mesh {

/// The cubic B-spline of particle-mesh methods (Hockney and Eastwood, Computer Simulation Using Particles, 1988): four
/// points per axis share a particle's value; the weights are smooth, add up to 1 and keep the first moment.
struct CubicSpline {
  static constexpr int points = points_per_axis;

  /// Weights of the four points, the first below the particle's cell, each `Width` times. `fraction`: position f in the
  /// cell, 0 to 1. The weights are (1 - f)^3 / 6, 2/3 - f^2 + f^3 / 2, the same with 1 - f for f, and f^3 / 6.
  template <int Width, class Real>
  [[gnu::always_inline]] static FourPoints<Real, Width> weights(Real fraction) {
    using Pack = FourPoints<Real, Width>;
    const Pack f(fraction);
    Pack weight = load<Pack>(factors<Width, Real>[3].data());
    for (std::size_t power = 3; power-- > 0;) weight = weight * f + load<Pack>(factors<Width, Real>[power].data());
    return weight;
  }

 private:
  /// Of the powers 0 to 3 of f in the weights.
  template <int Width, class Real>
  static constexpr auto factors = [] {
    constexpr double sixths[4][points] = {{1, 4, 1, 0}, {-3, 0, 3, 0}, {3, -6, 3, 0}, {-1, 3, -3, 1}};
    std::array<std::array<Real, points * Width>, 4> all{};
    for (std::size_t power = 0; power < 4; ++power)
      for (std::size_t n = 0; n < all[power].size(); ++n)
        all[power][n] = static_cast<Real>(sixths[power][n / Width] / 6.0);
    return all;
  }();
};

}  // namespace mesogen::mesh
