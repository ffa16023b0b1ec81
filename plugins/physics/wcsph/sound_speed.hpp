#pragma once

// How fast the sound of a weakly compressible flow has to be.

#include <algorithm>
#include <cmath>

#include "mesogen/plugin/scene.hpp"

namespace mesogen::wcsph {

/// delta by default, and as large as a creeping flow may have it.
inline constexpr double usual_variation = 0.01;
inline constexpr double creeping_variation = 0.05;

/// Stresses that come and go may compress the fluid this many times as much as lasting ones.
inline constexpr double passing_share = 5.0;

/// c0^2 >= max(100 u^2, stress / (rho delta), mu u / (rho L delta)) (Morris et al. 1997), and for passing stresses,
/// such as those of a distorted start, stress / (5 rho delta); m/s. `length`: shortest edge of the box.
/// `density`: kg/m3; `viscosity`: Pa s; `density_variation`: delta, the relative variation that is accepted.
inline double needed_sound_speed(double density, double viscosity, double density_variation, const Scales& scales,
                                 double length) {
  const double stiffness = density * density_variation;
  return std::sqrt(
      std::max({100.0 * scales.speed * scales.speed, scales.stress / stiffness,
                scales.passing_stress / (passing_share * stiffness), viscosity * scales.speed / (length * stiffness)}));
}

}  // namespace mesogen::wcsph
