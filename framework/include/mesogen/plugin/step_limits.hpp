#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mesogen/export.hpp"

namespace mesogen {

/// Cause of a limit on the step.
enum class StepCause {
  nothing,
  sound,            ///< time in which sound crosses a smoothing length
  viscosity,        ///< diffusion of momentum
  friction,         ///< decay of momentum by friction
  elasticity,       ///< diffusion of the order tensor
  elastic_waves,    ///< waves of the director against the fluid's inertia
  bulk_relaxation,  ///< relaxation of the order
  shear,            ///< velocity gradients
  other,            ///< any other cause; the rule of the limit names it
  acceleration,     ///< acceleration of particles
  speed,            ///< speed of particles
  given,            ///< the case gives the step
};

/// "sound", "elastic waves", ...; empty for `other`.
MESOGEN_EXPORT std::string_view to_string(StepCause cause);

/// Limits on the step. The smallest limit counts.
class MESOGEN_EXPORT StepLimits {
 public:
  struct Limit {
    StepCause cause;
    std::string text;  ///< "sound: 0.25 h / c0"
    double seconds;
  };
  /// `rule`: formula of the limit, "0.25 h / c0". `seconds`: its value.
  void add(StepCause cause, std::string_view rule, double seconds);
  [[nodiscard]] const std::vector<Limit>& all() const { return limits_; }

 private:
  std::vector<Limit> limits_;
};

}  // namespace mesogen
