#include "run/stepper.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "plugin/plugin_call.hpp"
#include "run/planned_fields.hpp"
#include "time/timing.hpp"

namespace mesogen {

namespace {

Particles initial_particles(const Arrangement& arrangement, int dimension, exec::DeviceMemory* memory) {
  Particles particles(memory);
  particles.dimension = dimension;
  particles.id.resize_for_overwrite(static_cast<std::size_t>(arrangement.count));
  const auto id = particles.id.host(exec::Access::write);
  std::iota(id.begin(), id.end(), 0);
  for (int d = 0; d < dimension; ++d) {
    particles.position[d].assign(arrangement.position[d]);
    particles.images[d].resize(id.size());
  }
  return particles;
}

bool moves(const Transport& flow) { return !flow.velocity.empty() && !flow.fixed; }

// Where nobody needs neighbours: often enough for the order of storage to follow the particles.
constexpr std::int64_t steps_between_orderings = 32;

/// Where a plugin keeps numbers of its own.
std::span<double> numbers_of(const Setup::PhysicsMember& member, const PassList::Kept& kept) {
  std::span<double> numbers;
  call_plugin(member.type, "keep(\"" + kept.name + "\")", [&] { numbers = kept.where(); });
  if (numbers.size() != kept.count)
    throw Error(ExitCode::plugin_refused, member.instance + " keeps '" + kept.name + "' as " +
                                              std::to_string(numbers.size()) + " numbers, where it told of " +
                                              std::to_string(kept.count) + ": name the number that there are");
  return numbers;
}

TimeScheme time_scheme(const std::string& name) {
  return name == "midpoint" ? TimeScheme::midpoint : TimeScheme::half_steps;
}

}  // namespace

Stepper::Stepper(Setup& setup)
    : setup_(setup),
      state_(setup.scene, setup.smoothing, *setup.boundary,
             initial_particles(setup.arrangement, setup.scene.dimension, setup.backend->memory()), *setup.backend),
      derived_((add_fields(), std::make_unique<DerivedFields>(
                                  state_, setup.catalogue, setup.graph->derived_for_integration(),
                                  [&] {
                                    std::vector<std::set<std::string>> readers;
                                    for (std::size_t n = 0; n <= setup.observers.size(); ++n)
                                      readers.push_back(setup.graph->derived_for_reader(n));
                                    return readers;
                                  }(),
                                  DerivedFields::Form{.consistent_laplacian = setup.source.laplacian == "consistent",
                                                      .particles_move = moves(setup.graph->transport())}))),
      executor_(state_, *setup.graph, *derived_),
      integrator_(state_, setup.catalogue, setup.graph->transport(), time_scheme(setup.source.time.scheme)),
      control_(setup.scene, setup.limits, setup.source.time.step, setup.source.time.factor),
      guard_(state_, setup.catalogue, *setup.graph, integrator_, control_),
      watches_(setup, state_, integrator_) {
  state_.units = setup.source.units;
  set_initial_fields();
}

void Stepper::add_fields() {
  for (const PlannedField& field : planned_fields(setup_))
    state_.add_field(field.name, field.components, field.integrated).kind = field.kind;
}

void Stepper::set_initial_fields() {
  for (const auto& member : setup_.initial) {
    InitialState state = initial_state(member, setup_);
    for (const FieldDeclaration& declared : member.plan.fields()) {
      Field* const field = state_.fields.find(declared.name);
      if (field == nullptr) continue;
      for (int c = 0; c < field->components(); ++c) {
        const auto values = state.component(declared.name, c);
        for (Index i = 0; i < state_.particles.count(); ++i) field->set(c, i, values[static_cast<std::size_t>(i)]);
      }
      ++field->version;
    }
  }
}

void Stepper::start() {
  state_.step_size = 0.0;
  keep_order();
  const std::vector<bool> all(setup_.observers.size() + 1, true);
  for (const Phase phase : {Phase::begin, Phase::rates, Phase::end}) executor_.run(phase, all);
  motion_.fastest = integrator_.fastest();
  motion_.largest_acceleration = integrator_.largest_acceleration();
}

Stepper::Step Stepper::next_step(double mark) const {
  const StepControl::Choice longest = longest_step();
  const EqualSteps steps = equal_steps(mark - state_.time, longest.seconds);
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
  const double sum = state_.time + step_size;
  const double multiple = std::round(sum / step_size) * step_size;
  return control_.fixed() && std::abs(sum - multiple) < 1e-9 * step_size ? rounded_time(multiple) : sum;
}

void Stepper::advance(const Step& step, const std::vector<bool>& reader_due) {
  const double begun = state_.time;
  const double step_size = step.seconds;
  const Span span(whole_, state_.trace);
  const auto timed = [this](Counter& counter, const auto& action) {
    const Span part(counter, state_.trace);
    action();
    state_.end_of_work();
  };
  state_.return_to_order();
  state_.step_size = step_size;
  timed(integration_, [&] { integrator_.predict(step_size); });
  keep_order();
  state_.time = begun + step_size / 2.0;
  executor_.run(Phase::begin, reader_due);
  executor_.run(Phase::rates, reader_due);
  state_.return_to_order();
  timed(integration_, [&] { motion_ = integrator_.correct(step_size); });
  state_.time = step.arrival;
  ++state_.step;
  timed(guarding_, [&] { guard_.check(motion_); });
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
    state_.settle();
  } else if (state_.step % steps_between_orderings == 0) {
    state_.reorder();
  }
}

void Stepper::save(Checkpoint& checkpoint) {
  state_.return_to_order();
  const auto list = [](const auto& array) {
    const auto values = array.host();
    return std::vector(values.begin(), values.end());
  };
  checkpoint.step = state_.step;
  checkpoint.time = state_.time;
  checkpoint.step_size = state_.step_size;
  checkpoint.precision = state_.scene.precision;
  checkpoint.dimension = state_.scene.dimension;
  checkpoint.integers["id"] = list(state_.particles.id);
  for (int d = 0; d < state_.scene.dimension; ++d) {
    const std::string axis = std::to_string(d);
    checkpoint.numbers["position " + axis] = list(state_.particles.position[d]);
    checkpoint.numbers["sorted position " + axis] = list(state_.neighbourhood.sorted_position()[d]);
    const auto images = state_.particles.images[d].host();
    checkpoint.integers["images " + axis].assign(images.begin(), images.end());
  }
  for (const std::string& name : checkpointed_fields(setup_)) {
    const Field& field = state_.fields.at(name);
    const FieldReader value = field.reader();
    for (int c = 0; c < field.components(); ++c) {
      auto& values = checkpoint.numbers["field " + name + " " + std::to_string(c)];
      values.resize(state_.particles.id.size());
      for (Index i = 0; i < state_.particles.count(); ++i) values[static_cast<std::size_t>(i)] = value(c, i);
    }
  }
  // The next step goes by it. What it was found in is not always saved: a rate is, if its field is predicted by it.
  checkpoint.numbers["largest acceleration"] = {motion_.largest_acceleration};
  for (const auto& member : setup_.physics) {
    for (const auto& kept : member.passes.kept()) {
      const auto numbers = numbers_of(member, kept);
      checkpoint.numbers[member.instance + " keeps " + kept.name].assign(numbers.begin(), numbers.end());
    }
  }
}

void Stepper::restore(const Checkpoint& checkpoint) {
  const auto take_of = [&](const auto& map, const std::string& name, std::size_t size,
                           const std::string& what) -> const auto& {
    const auto at = map.find(name);
    if (at == map.end() || at->second.size() != size)
      throw Error(ExitCode::bad_case, "the checkpoint has no '" + name + "' for " + std::to_string(size) + " " + what +
                                          ": it belongs to another case");
    return at->second;
  };
  const auto take = [&](const auto& map, const std::string& name) -> const auto& {
    return take_of(map, name, state_.particles.id.size(), "particles");
  };
  state_.return_to_order();
  state_.step = whole_.runs = checkpoint.step;
  state_.time = checkpoint.time;
  state_.step_size = checkpoint.step_size;
  state_.particles.id.assign(take(checkpoint.integers, "id"));
  std::vector<bool> seen(state_.particles.id.size(), false);
  for (const std::int64_t id : state_.particles.id.host()) {
    if (id < 0 || id >= state_.particles.count() || seen[static_cast<std::size_t>(id)])
      throw Error(ExitCode::bad_case, "the checkpoint names particle " + std::to_string(id) +
                                          " twice, or it is none of this case: it belongs to another one");
    seen[static_cast<std::size_t>(id)] = true;
  }
  // A branch may have other cells.
  const bool sorted_alike = checkpoint.numbers.contains("sorted position 0");
  std::array<std::vector<double>, 3> sorted;
  for (int d = 0; d < state_.scene.dimension; ++d) {
    const std::string axis = std::to_string(d);
    state_.particles.position[d].assign(take(checkpoint.numbers, "position " + axis));
    if (sorted_alike) sorted[d] = take(checkpoint.numbers, "sorted position " + axis);
    const auto& images = take(checkpoint.integers, "images " + axis);
    const auto to = state_.particles.images[d].host(exec::Access::write);
    for (std::size_t i = 0; i < images.size(); ++i) to[i] = static_cast<std::int32_t>(images[i]);
  }
  for (const std::string& name : checkpointed_fields(setup_)) {
    Field& field = state_.fields.at(name);
    for (int c = 0; c < field.components(); ++c) {
      const auto& values = take(checkpoint.numbers, "field " + name + " " + std::to_string(c));
      for (Index i = 0; i < state_.particles.count(); ++i) field.set(c, i, values[static_cast<std::size_t>(i)]);
    }
    ++field.version;
  }
  for (const auto& member : setup_.physics) {
    for (const auto& kept : member.passes.kept()) {
      const auto& numbers = take_of(checkpoint.numbers, member.instance + " keeps " + kept.name, kept.count, "numbers");
      std::copy(numbers.begin(), numbers.end(), numbers_of(member, kept).begin());
    }
  }
  ask_limits();
  sorted_alike ? state_.restore_order(sorted) : state_.sort_anew();
  motion_.fastest = integrator_.fastest();
  motion_.largest_acceleration = take_of(checkpoint.numbers, "largest acceleration", 1, "numbers").front();
}

std::vector<Counter> Stepper::shares() const {
  std::vector<Counter> all = {integration_, guarding_};
  for (const ScheduledPass& scheduled : setup_.graph->passes())
    if (!scheduled.pruned()) all.push_back(scheduled.counter);
  for (const auto& counters : {derived_->counters(), state_.counters()})
    all.insert(all.end(), counters.begin(), counters.end());
  return all;
}

}  // namespace mesogen
