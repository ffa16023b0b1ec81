#include "mesogen/plugin/step_limits.hpp"

namespace mesogen {

std::string_view to_string(StepCause cause) {
  switch (cause) {
    case StepCause::nothing: return "nothing";
    case StepCause::sound: return "sound";
    case StepCause::viscosity: return "viscosity";
    case StepCause::friction: return "friction";
    case StepCause::elasticity: return "elasticity";
    case StepCause::elastic_waves: return "elastic waves";
    case StepCause::bulk_relaxation: return "bulk relaxation";
    case StepCause::shear: return "shear";
    case StepCause::other: return "";
    case StepCause::acceleration: return "acceleration";
    case StepCause::speed: return "speed";
    case StepCause::given: return "time.step of the case";
  }
  return "";
}

void StepLimits::add(StepCause cause, std::string_view rule, double seconds) {
  std::string text(to_string(cause));
  if (!text.empty() && !rule.empty()) text += ": ";
  limits_.push_back({cause, text + std::string(rule), seconds});
}

}  // namespace mesogen
