#pragma once

// Whether a scene would be better off without sound, for `mesogen check`.

#include <algorithm>
#include <limits>
#include <vector>

#include "mesogen/plugin/physics.hpp"

namespace mesogen::wcsph {

/// Suggests an incompressible flow where `own`, the step (s) that sound and viscosity allow, is far below what motion
/// and the rest of the physics need.
inline void suggest_no_sound(const Scene& scene, const StepLimits& limits, double own, std::vector<Suggestion>& list) {
  for (int d = 0; d < scene.dimension; ++d)
    if (!scene.periodic[static_cast<std::size_t>(d)]) return;
  double others = std::numeric_limits<double>::infinity();
  for (const auto& limit : limits.all()) {
    // Diffusion and friction limit no step of that flow.
    const auto is = [&](const char* begin) { return limit.name.starts_with(begin); };
    if (!is("sound") && !is("viscosity") && !is("elasticity") && !is("friction"))
      others = std::min(others, limit.seconds);
  }
  if (scene.scales.speed > 0.0) others = std::min(others, 0.2 * scene.spacing / scene.scales.speed);
  if (!(others > 4.0 * own)) return;
  list.push_back({"no_sound",
                  "sound or viscosity bind the step, and this box is periodic: an incompressible flow needs neither",
                  {"type=incompressible"},
                  "far fewer steps, and a flow solved to the accuracy of Fourier series; lost: sound, compression and "
                  "the density's equation, walls"});
}

}  // namespace mesogen::wcsph
