#pragma once

#include <array>
#include <vector>

#include "mesogen/plugin/scene.hpp"

namespace mesogen::test {

/// Coordinates by axis in a square box of edge 1 m; a square number of particles.
using Points = std::array<std::vector<double>, 2>;

/// Relative L2 errors of derivatives.
struct OperatorErrors {
  double gradient;
  double laplacian;
};

struct OperatorChoice {
  bool consistent_laplacian = false;  ///< kernel.laplacian = "consistent"
  Precision precision = Precision::double_precision;
};

/// Errors for sin(k x + 0.3) cos(k y + 0.7) of `waves` waves along each axis, with the quintic kernel, h = 4/3
/// spacings. More waves on the same particles are a coarser resolution of the same disorder.
OperatorErrors operator_errors(const Points& points, int waves, const OperatorChoice& choice);

/// Where the particles of an extensile turbulence (as cases/quickstart) are after so many steps, single precision.
Points points_after_turbulence(int across, int steps);

/// Order p of error ~ spacing^p: the slope through logarithms, by least squares. `resolution`: points per wave.
double fitted_order(const std::vector<double>& resolution, const std::vector<double>& error);

}  // namespace mesogen::test
