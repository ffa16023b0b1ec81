#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mesogen/export.hpp"

namespace mesogen {

/// What limits a step.
enum class StepCause {
  nothing,
  sound,            ///< sound crosses a smoothing length
  viscosity,        ///< diffusion of momentum
  friction,         ///< decay of momentum by friction
  elasticity,       ///< diffusion of the order tensor
  elastic_waves,    ///< the director against the fluid's inertia
  bulk_relaxation,  ///< relaxation of the order
  shear,            ///< velocity gradients
  other,            ///< what else a plugin knows; its rule says what
  acceleration,     ///< of particles
  speed,            ///< of particles
  given,            ///< the case gives the step
};

/// "sound", "elastic waves", ...; empty for `other`.
MESOGEN_EXPORT std::string_view to_string(StepCause cause);

/// Limits on the step; the smallest binds.
class MESOGEN_EXPORT StepLimits {
 public:
  struct Limit {
    StepCause cause;
    std::string text;  ///< "sound: 0.25 h / c0"
    double seconds;
  };
  /// `rule`: how the limit is made, "0.25 h / c0".
  void add(StepCause cause, std::string_view rule, double seconds);
  [[nodiscard]] const std::vector<Limit>& all() const { return limits_; }

 private:
  std::vector<Limit> limits_;
};

}  // namespace mesogen
