#pragma once

// What fits of modes to particles have in common on the host and on a device.

#include <array>
#include <cmath>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/mesh/grid.hpp"

namespace mesogen::mesh {

/// Factor of a wave's amplitude when it is spread with cubic B-splines, and when it is interpolated:
/// sinc^4(half wave number times mesh spacing).
inline double spline_transform(double half_phase) {
  if (std::abs(half_phase) < 1e-8) return 1.0;
  const double sinc = std::sin(half_phase) / half_phase;
  return sinc * sinc * sinc * sinc;
}

/// 1 / (factor by which spreading reduces a wave).
template <int Dim>
double restoring_factor(const Grid<Dim>& grid, const std::array<double, Dim>& k) {
  double left = 1.0;
  for (int d = 0; d < Dim; ++d) left *= spline_transform(0.5 * k[d] * grid.spacing(d));
  return 1.0 / left;
}

/// Weight of a point with hardly any particle, over the mean weight.
inline constexpr double empty_weight = 1e-3;

inline Error hardly_any_particle() {
  return Error(ExitCode::run_failed,
               "a point of the mesh has hardly any particle about it: leave the shift of the flow at its default, or "
               "take a coarser mesh (mesh_spacing of a flow on a mesh)");
}
inline Error shared_on_devices() {
  return Error(ExitCode::bad_case,
               "several ranks share a mesh on the host alone: set run.device = \"cpu\", or run it on one rank");
}
inline Error not_finite() { return Error(ExitCode::run_failed, "the coordinate of a particle is not finite"); }

/// How often a fit is corrected: no more than is allowed, and only while much is missing. The first guess misses about
/// a share u, the unevenness, of a field. A correction misses 3 u of what it corrects (measured on lattices with jitter
/// and in turbulence).
class Corrections {
 public:
  Corrections(int allowed, double unevenness) : left_(allowed), missing_(unevenness), factor_(3.0 * unevenness) {}

  /// Whether there is to be one more.
  bool next() {
    if (left_ <= 0 || !(missing_ > enough)) return false;
    --left_;
    missing_ *= factor_;
    return true;
  }

 private:
  static constexpr double enough = 3e-3;  // share of a field that may be missing

  int left_;
  double missing_;
  double factor_;
};

}  // namespace mesogen::mesh
