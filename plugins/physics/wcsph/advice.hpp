#pragma once

// What `mesogen check` tells about sound and inertia of a weakly compressible flow.

#include <string>
#include <vector>

#include "mesogen/plugin/advice.hpp"

namespace mesogen::wcsph {

/// What the advice is about.
struct FlowChoice {
  double sound_speed;            ///< c0, m/s
  double automatic_sound_speed;  ///< what it would be by itself, m/s
  double density;                ///< the fluid's, kg/m3
  double creeping_density;       ///< that of inertia = false, kg/m3; infinite if the scene does not tell
  bool inertia;
  /// c0 for creeping_variation, m/s, where the flow is creeping and c0 follows from the usual density_variation;
  /// otherwise 0
  double slower_sound_speed;
  double sound_step;   ///< that sound allows, s
  double step;         ///< that sound and viscosity allow, s
  bool only_defaults;  ///< the case gives no key of this plugin's own
};

void advise(const FlowChoice& flow, const AdviceContext& context, std::vector<Suggestion>& list);

}  // namespace mesogen::wcsph
