#pragma once

// A diffusion that takes any step.

#include <algorithm>

#include "mesogen/mesh/kept_modes.hpp"

namespace mesogen::incompressible {

/// Largest wave number that the mesh carries in every direction, 1/m.
template <int Dim>
double smallest_cutoff(const mesh::KeptModes<Dim>& kept) {
  double least = kept.cutoff(0);
  for (int d = 1; d < Dim; ++d) least = std::min(least, kept.cutoff(d));
  return least;
}

/// A diffusion that decays with z a step is slowed down to z limited(z): by no more than z^2 of itself where steps are
/// short, so second order in time, and never beyond what an explicit step bears (0.67, where 1 is stable).
MESOGEN_HOST_DEVICE inline double limited(double z) { return (1.0 + 0.5 * z) / (1.0 + 0.5 * z + z * z); }

}  // namespace mesogen::incompressible
