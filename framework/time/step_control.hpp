#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesogen/export.hpp"
#include "mesogen/plugin/scene.hpp"
#include "mesogen/plugin/step_limits.hpp"

namespace mesogen {

/// Chooses the step: the smallest of the plugins' limits and of those of motion,
/// 0.25 sqrt(h / |a|max) and 0.2 dx / |u|max (stabilised steps: 0.5 dx / |u|max), times the case's factor; or the
/// case's own step.
class MESOGEN_EXPORT StepControl {
 public:
  StepControl(const Scene& scene, StepLimits limits, std::optional<double> fixed, double factor);

  struct Choice {
    double seconds;
    std::string limit;  ///< what binds, in words
    StepCause cause;
  };
  [[nodiscard]] Choice choose(double fastest, double largest_acceleration) const;
  /// What the plugins' limits alone allow at the start of the run, s; infinite if there are none.
  [[nodiscard]] double at_rest() const { return at_rest_; }
  /// Those of plugins that have adapted their numerics.
  void set_limits(StepLimits limits) { limits_ = std::move(limits); }
  /// The plugins'.
  [[nodiscard]] const StepLimits& limits() const { return limits_; }
  [[nodiscard]] bool fixed() const { return fixed_.has_value(); }

 private:
  double spacing_;
  double smoothing_length_;
  bool stabilised_;
  StepLimits limits_;
  std::optional<double> fixed_;
  double factor_;
  double at_rest_;
};

}  // namespace mesogen
