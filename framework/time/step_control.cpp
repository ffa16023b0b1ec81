#include "time/step_control.hpp"

#include <cmath>
#include <limits>

namespace mesogen {

StepControl::StepControl(const Scene& scene, StepLimits limits, std::optional<double> fixed, double factor)
    : spacing_(scene.spacing),
      smoothing_length_(scene.smoothing_length),
      limits_(std::move(limits)),
      fixed_(fixed),
      factor_(factor),
      at_rest_(choose(0.0, 0.0).seconds) {}

StepControl::Choice StepControl::choose(double fastest, double largest_acceleration) const {
  if (fixed_) return {*fixed_, "time.step of the case"};
  Choice choice{std::numeric_limits<double>::infinity(), "nothing"};
  const auto bind = [&](const std::string& name, double seconds) {
    if (seconds < choice.seconds) choice = {seconds, name};
  };
  for (const auto& limit : limits_.all()) bind(limit.name, limit.seconds);
  if (largest_acceleration > 0.0)
    bind("acceleration: 0.25 sqrt(h / |a|)", 0.25 * std::sqrt(smoothing_length_ / largest_acceleration));
  if (fastest > 0.0) bind("speed: 0.2 dx / |u|", 0.2 * spacing_ / fastest);
  choice.seconds *= factor_;
  return choice;
}

}  // namespace mesogen
