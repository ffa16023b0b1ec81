#include "time/step_control.hpp"

#include <cmath>
#include <limits>

namespace mesogen {

StepControl::StepControl(const Scene& scene, StepLimits limits, std::optional<double> fixed, double factor)
    : spacing_(scene.spacing),
      smoothing_length_(scene.smoothing_length),
      stabilised_(scene.stabilised_steps),
      limits_(std::move(limits)),
      fixed_(fixed),
      factor_(factor),
      at_rest_(choose(0.0, 0.0).seconds) {}

StepControl::Choice StepControl::choose(double fastest, double largest_acceleration) const {
  if (fixed_) return {*fixed_, std::string(to_string(StepCause::given)), StepCause::given};
  StepLimits all = limits_;
  if (largest_acceleration > 0.0)
    all.add(StepCause::acceleration, "0.25 sqrt(h / |a|)", 0.25 * std::sqrt(smoothing_length_ / largest_acceleration));
  if (fastest > 0.0)
    all.add(StepCause::speed, stabilised_ ? "0.5 dx / |u|" : "0.2 dx / |u|",
            (stabilised_ ? 0.5 : 0.2) * spacing_ / fastest);
  Choice choice{std::numeric_limits<double>::infinity(), "nothing", StepCause::nothing};
  for (const auto& limit : all.all())
    if (limit.seconds < choice.seconds) choice = {limit.seconds, limit.text, limit.cause};
  choice.seconds *= factor_;
  return choice;
}

}  // namespace mesogen
