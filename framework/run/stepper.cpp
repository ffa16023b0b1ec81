#include "run/stepper.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "run/state_at_start.hpp"
#include "run/state_checkpoint.hpp"
#include "time/timing.hpp"

namespace mesogen {

namespace {

bool moves(const Transport& flow) { return !flow.velocity.empty() && !flow.fixed; }

// Where nobody needs neighbours: often enough for the order of storage to follow the particles.
constexpr std::int64_t steps_between_orderings = 32;

const std::string acceleration_name = "largest acceleration";  // in checkpoints

bool diffuses(const std::vector<LinearTerms>& staged) {
  return std::ranges::any_of(staged, [](const LinearTerms& terms) { return terms.diffusion.any(); });
}

TimeScheme time_scheme(const std::string& name) {
  return name == "midpoint" ? TimeScheme::midpoint : TimeScheme::half_steps;
}

}  // namespace

Stepper::Stepper(Setup& setup)
    : setup_(setup),
      state_(state_at_start(setup)),
      prescribed_(*state_, setup.prescribed),
      derived_(*state_, setup.catalogue, setup.graph->derived_for_integration(), setup.graph->derived_for_readers(),
               DerivedFields::Form{.consistent_laplacian = setup.source.laplacian == "consistent",
                                   .particles_move = moves(setup.graph->transport()),
                                   .stages = diffuses(setup.graph->staged())},
               &prescribed_),
      executor_(*state_, *setup.graph, derived_),
      stages_(*state_, derived_, setup.graph->staged(), largest_laplacian(setup)),
      integrator_(*state_, setup.catalogue, setup.graph->transport(), time_scheme(setup.source.time.scheme), stages_),
      control_(setup.scene, setup.limits, setup.source.time.step, setup.source.time.factor),
      guard_(*state_, setup.catalogue, *setup.graph, integrator_, control_),
      watches_(setup, *state_, integrator_),
      momentum_(setup, *state_) {}

void Stepper::start() {
  state_->step_size = 0.0;
  keep_order();
  const std::vector<bool> all(setup_.observers.size() + 1, true);
  for (const Phase phase : {Phase::begin, Phase::rates}) executor_.run(phase, all);
  integrator_.start();
  executor_.run(Phase::end, all);
  momentum_.start();
  motion_.fastest = integrator_.fastest();
  motion_.largest_acceleration = integrator_.largest_acceleration();
}

Stepper::Step Stepper::next_step(double mark) const {
  const StepControl::Choice longest = longest_step();
  const EqualSteps steps = equal_steps(mark - state_->time, longest.seconds);
  return {steps.seconds, steps.count > 1.0 ? arrival_after(steps.seconds) : mark, longest.limit};
}

Stepper::Step Stepper::next_step(const Marks& marks, double end) const {
  return next_step(marks.next(arrival(), end, longest_step().seconds));
}

StepControl::Choice Stepper::longest_step() const {
  return control_.choose(motion_.fastest, motion_.largest_acceleration);
}

// In a run of equal steps the time is a multiple of the step, however it was reached.
double Stepper::arrival_after(double step_size) const {
  const double sum = state_->time + step_size;
  const double multiple = std::round(sum / step_size) * step_size;
  return control_.fixed() && std::abs(sum - multiple) < 1e-9 * step_size ? rounded_time(multiple) : sum;
}

void Stepper::advance(const Step& step, const std::vector<bool>& reader_due) {
  const double begun = state_->time;
  const double step_size = step.seconds;
  const Span span(whole_, state_->clock.trace);
  const auto timed = [this](Counter& counter, const auto& action) {
    const Span part(counter, state_->clock.trace);
    action();
    state_->clock.end_of_work();
  };
  state_->order.return_to_integration();
  state_->step_size = step_size;
  timed(integration_, [&] { integrator_.predict(step_size, motion_); });
  keep_order();
  state_->time = begun + step_size / 2.0;
  executor_.run(Phase::begin, reader_due);
  std::function<void()> advance_velocity;
  if (integrator_.stages_velocity())
    advance_velocity = [&] { timed(integration_, [&] { integrator_.advance_velocity(step_size); }); };
  executor_.run(Phase::rates, reader_due, advance_velocity);
  state_->order.return_to_integration();
  // All that is looked for at the end of a step comes with one wait.
  timed(integration_, [&] { integrator_.correct(step_size); });
  timed(guarding_, [&] { guard_.look(); });
  timed(integration_, [&] {
    state_->wait();
    motion_ = integrator_.motion();
  });
  state_->time = step.arrival;
  ++state_->step;
  timed(guarding_, [&] { guard_.check(motion_); });
  if (momentum_.due())
    timed(integration_, [&] {
      momentum_.keep();
      motion_.fastest = integrator_.fastest();
    });
  changes_ = watches_.look();
  if (!changes_.empty()) ask_limits();
  executor_.run(Phase::end, reader_due);
  if (integrator_.velocity_by_passes()) {
    timed(integration_, [&] { integrator_.look(step_size, motion_); });
    guard_.check_finite(motion_);
  }
}

void Stepper::ask_limits() {
  StepLimits limits;
  for (const auto& member : setup_.physics)
    if (member.plugin) add_step_limits(member, setup_, limits);
  control_.set_limits(std::move(limits));
}

void Stepper::keep_order() {
  if (setup_.graph->sums_pairs()) {
    state_->order.settle();
  } else if (state_->step % steps_between_orderings == 0) {
    state_->order.sort_for_memory();
  }
}

void Stepper::save(Checkpoint& checkpoint) {
  save_state(setup_, *state_, checkpoint);
  // The next step goes by it. What it was found in is not always saved: a rate is, if its field is predicted by it.
  checkpoint.numbers[acceleration_name] = {motion_.largest_acceleration};
  momentum_.save(checkpoint);
}

void Stepper::restore(const Checkpoint& checkpoint) {
  restore_state(setup_, checkpoint, *state_);
  momentum_.restore(checkpoint);
  whole_.runs = state_->step;
  ask_limits();
  motion_ = {};
  motion_.fastest = integrator_.fastest();
  motion_.largest_acceleration = stored(checkpoint.numbers, acceleration_name, 1, "numbers").front();
}

std::vector<Counter> Stepper::shares() const {
  std::vector<Counter> all = {integration_, guarding_};
  for (const ScheduledPass& scheduled : setup_.graph->passes())
    if (!scheduled.pruned()) all.push_back(scheduled.counter);
  if (!setup_.prescribed.empty()) all.push_back(prescribed_.counter());
  for (const auto& counters :
       {derived_.counters(), std::vector{state_->order.counter(), state_->boundary_values.counter()}})
    all.insert(all.end(), counters.begin(), counters.end());
  return all;
}

}  // namespace mesogen
