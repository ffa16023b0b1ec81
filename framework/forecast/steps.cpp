#include "forecast/steps.hpp"

#include <cmath>

#include "time/step_control.hpp"

namespace mesogen {

namespace {

double count(double end, double step) { return std::isfinite(step) ? std::ceil(end / step * (1.0 - 1e-9)) : 2.0; }

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

double times_due(const Setup& setup, std::size_t reader, double steps) {
  const double end = setup.source.time.end;
  const bool output = reader == setup.observers.size();
  const auto timing = output ? ObserverTiming{setup.source.output.interval, {}} : setup.observers[reader].timing;
  const double last = 1.0;
  if (timing.every) return std::floor(steps / static_cast<double>(*timing.every)) + last;
  if (timing.interval) return std::ceil(end / *timing.interval * (1.0 - 1e-9));
  return last;
}

}  // namespace mesogen
