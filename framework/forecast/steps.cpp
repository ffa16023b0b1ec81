#include "forecast/steps.hpp"

#include <algorithm>
#include <cmath>

#include "run/marks_of.hpp"
#include "time/stages.hpp"
#include "time/step_control.hpp"

namespace mesogen {

namespace {

// Beyond, the run goes on as it went so far.
constexpr int most_marks = 20000;

/// Steps of a run to `end` that may last `longest`, s: cut so that they end on the marks.
double count(const Marks& marks, double end, double longest) {
  Arrival now;
  double steps = 0.0;
  for (int n = 0; n < most_marks && now.time < end; ++n) {
    const double mark = marks.next(now, end, longest);
    const EqualSteps cut = equal_steps(mark - now.time, longest);
    steps += cut.count;
    now = {mark, cut.seconds};
  }
  return now.time < end ? std::ceil(steps * (end / now.time)) : steps;
}

}  // namespace

StepForecast forecast_steps(const Setup& setup) {
  const auto& time = setup.source.time;
  const Marks marks = marks_of(setup);
  const StepControl control(setup.scene, setup.limits, time.step, time.factor);
  StepForecast steps;
  steps.fixed = control.fixed();
  const auto rest = control.choose(0.0, 0.0);
  steps.first = rest.seconds;
  steps.limit = rest.limit;
  steps.cause = rest.cause;
  steps.at_rest = count(marks, time.end, rest.seconds);
  if (!setup.graph->transport().velocity.empty()) steps.speed = setup.scene.scales.speed;
  const auto moving = control.choose(steps.speed, 0.0);
  steps.at_speed = moving.seconds;
  steps.limit_at_speed = moving.limit;
  steps.expected = count(marks, time.end, moving.seconds);
  const double step_size = std::min(moving.seconds, time.end);
  for (const LinearTerms& terms : setup.graph->staged())
    steps.stages[terms.field] = stages_needed(largest_rate(terms, largest_laplacian(setup)), step_size);
  return steps;
}

double times_due(const Setup& setup, std::size_t reader, double steps) {
  return marks_of(setup).readers()[reader].count_in_run(setup.source.time.end, steps);
}

double frames_stored(const Setup& setup) { return 1.0 + times_due(setup, setup.observers.size(), 0.0); }

double checkpoints_kept(const Setup& setup) { return marks_of(setup).kept().count(setup.source.time.end); }

double checkpoints_stored(const Setup& setup) {
  const double newest = 2.0;
  const double before_end = marks_of(setup).has(setup.source.time.end) ? 0.0 : 1.0;
  return newest + before_end + checkpoints_kept(setup);
}

}  // namespace mesogen
