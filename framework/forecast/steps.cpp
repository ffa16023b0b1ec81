#include "forecast/steps.hpp"

#include <cmath>

#include "time/step_control.hpp"

namespace mesogen {

namespace {

std::int64_t count(double end, double step) {
  return std::isfinite(step) ? static_cast<std::int64_t>(std::ceil(end / step * (1.0 - 1e-9))) : 2;
}

}  // namespace

StepForecast forecast_steps(const Setup& setup) {
  const auto& time = setup.source.time;
  const StepControl control(setup.scene, setup.limits, time.step, time.factor);
  StepForecast steps;
  steps.fixed = control.fixed();
  const auto rest = control.choose(0.0, 0.0);
  steps.first = rest.seconds;
  steps.limit = rest.limit;
  steps.at_rest = count(time.end, rest.seconds);
  if (!setup.graph->transport().velocity.empty()) steps.speed = setup.scene.scales.speed;
  const auto moving = control.choose(steps.speed, 0.0);
  steps.at_speed = moving.seconds;
  steps.limit_at_speed = moving.limit;
  steps.expected = count(time.end, moving.seconds);
  return steps;
}

}  // namespace mesogen
