#include "time/integrator.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "mesogen/exec/dispatch.hpp"
#include "particles/field_loops.hpp"

namespace mesogen {

namespace {

constexpr double most = std::numeric_limits<double>::max();

constexpr auto device = exec::Side::device;
// Also where particles are written alone: ghosts keep what they have.
constexpr auto read_write = exec::Access::read_write;

/// Looks for the largest squared length.
exec::Reduction look_for_largest(const Backend& backend, const Field& field, Index count) {
  // Of an advanced field the doubles: what a step found must be found again when a run is resumed.
  if (field.is_double() || field.integrated())
    return backend.fields<double>().largest_square(field.master(device), field.components(), count);
  return backend.fields<float>().largest_square(field.view<float>(device), field.components(), count);
}

double largest_length(const State& state, const Field* field) {
  if (field == nullptr) return 0.0;
  const exec::Reduction largest = look_for_largest(state.backend, *field, state.particles.count());
  state.wait();
  return std::sqrt(state.backend.found(largest));
}

}  // namespace

Integrator::Integrator(State& state, const Catalogue& catalogue, const Transport& transport, TimeScheme scheme,
                       Stages& stages)
    : state_(state), scheme_(scheme), stages_(stages), fixed_(transport.fixed) {
  for (const auto& [name, entry] : catalogue.all()) {
    if (!has_rate(entry.declaration.advance)) continue;
    Field& field = state.fields.at(name);
    Advanced one{&field, &state.fields.at(entry.declaration.rate), entry.declaration.advance == Advance::predicted,
                 nullptr, stages.of(name)};
    if (one.predicted && scheme == TimeScheme::midpoint) one.start = &state.add_copy_in_double(field);
    advanced_.push_back(one);
    if (name == transport.velocity) acceleration_ = one.rate;
  }
  if (!transport.velocity.empty()) velocity_ = &state.fields.at(transport.velocity);
  if (!transport.shift.empty()) shift_ = &state.fields.at(transport.shift);
  if (velocity_ != nullptr && acceleration_ == nullptr && !fixed_)
    way_to_midpoint_ = &state.add_in_double("way to the midpoint", velocity_->components());
  if (!transport.drive.empty()) drive_ = state.fields.find(transport.drive);
}

template <class Real>
exec::AdvanceArguments<Real> Integrator::advancing(const Advanced& one, Field& from, double by) const {
  return {std::as_const(from).master(device),    std::as_const(*one.rate).view<Real>(device), by,
          one.field->master(device, read_write), one.field->view<Real>(device, read_write),   one.field->components()};
}

void Integrator::advance(const Advanced& one, Field& from, double by) {
  dispatch(state_.scene.precision, [&]<class Real>() {
    state_.backend.fields<Real>().advance(advancing<Real>(one, from, by), state_.particles.count());
  });
  ++one.field->version;
}

void Integrator::advance_to_end(Advanced& one, double by) {
  Field& from = one.start != nullptr ? *one.start : *one.field;
  one.found = dispatch(state_.scene.precision, [&]<class Real>() {
    return state_.backend.fields<Real>().advance_and_look(advancing<Real>(one, from, by), state_.particles.count());
  });
  ++one.field->version;
}

template <class Arguments>
void Integrator::set_position(Arguments& arguments) const {
  arguments.dimension = state_.scene.dimension;
  for (int d = 0; d < state_.scene.dimension; ++d) {
    arguments.position[d] = state_.particles.position[d].device(read_write);
    if (state_.neighbourhood.sorted()) arguments.sorted[d] = state_.neighbourhood.sorted_position()[d].device();
  }
}

template <class Real>
exec::MoveArguments<Real> Integrator::moving(double by, double shift_by) const {
  exec::MoveArguments<Real> all{};
  set_position(all);
  all.velocity = std::as_const(*velocity_).master(device);
  all.by = by;
  if (shift_ != nullptr && shift_by != 0.0) all.shift = std::as_const(*shift_).view<Real>(device);
  all.shift_by = shift_by;
  return all;
}

template <class Real>
exec::MoveByPassesArguments<Real> Integrator::moving_by_passes(double step_size, bool to_midpoint) const {
  exec::MoveByPassesArguments<Real> all{};
  set_position(all);
  all.way = way_to_midpoint_->master(device, read_write);
  all.velocity = std::as_const(*velocity_).view<Real>(device);
  if (shift_ != nullptr && !to_midpoint) all.shift = std::as_const(*shift_).view<Real>(device);
  all.step_size = step_size;
  all.to_midpoint = to_midpoint;
  return all;
}

// From what the last step found follows how far particles can be from where they were sorted: mostly near enough for
// neighbours to be those of that sorting, so that nobody has to look, and wait for the answer.
void Integrator::move_to_midpoint(double step_size, const Motion& motion) {
  if (!moves()) return;
  const double fastest = motion.fastest + step_size / 2.0 * motion.largest_acceleration;
  const double farthest = motion.farthest + step_size / 2.0 * fastest;
  dispatch(state_.scene.precision, [&]<class Real>() {
    way_to_midpoint_ != nullptr ? state_.order.move(moving_by_passes<Real>(step_size, true), farthest)
                                : state_.order.move(moving<Real>(step_size / 2.0, 0.0), farthest);
  });
}

void Integrator::move_to_end(double step_size) {
  if (!moves()) return;
  farthest_ = dispatch(state_.scene.precision, [&]<class Real>() {
    const auto& loops = state_.backend.fields<Real>();
    return way_to_midpoint_ != nullptr
               ? loops.move_and_look(moving_by_passes<Real>(step_size, false), state_.particles.count())
               : loops.move_and_look(moving<Real>(step_size / 2.0, step_size), state_.particles.count());
  });
  state_.order.mark_moved();
}

void Integrator::start() {
  for (const Advanced& one : advanced_)
    if (one.in_stages != nullptr) stages_.take(*one.in_stages, 0.0);
}

// How far a field is predicted, s. A velocity in stages is not: advance_velocity() finds its value at the middle of the
// step. Nor is a stiff field in the first step, because its rate at the start tells nothing of the middle.
double Integrator::prediction(const Advanced& one, double step_size) const {
  const bool unknown = one.in_stages != nullptr && (one.field == velocity_ || state_.step == 0);
  return unknown ? 0.0 : step_size / 2.0;
}

void Integrator::predict(double step_size, const Motion& motion) {
  for (const Advanced& one : advanced_) {
    if (!one.predicted) continue;
    // The prediction is written where the start of the last step was.
    if (one.start != nullptr) one.start->exchange_master(*one.field);
    advance(one, one.start != nullptr ? *one.start : *one.field, prediction(one, step_size));
  }
  move_to_midpoint(step_size, motion);
}

const Integrator::Advanced* Integrator::staged_velocity() const {
  for (const Advanced& one : advanced_)
    if (one.field == velocity_ && one.in_stages != nullptr) return &one;
  return nullptr;
}

bool Integrator::stages_velocity() const { return staged_velocity() != nullptr; }

void Integrator::advance_velocity(double step_size) {
  const Advanced* const velocity = staged_velocity();
  if (velocity == nullptr) return;
  stages_.take(*velocity->in_stages, step_size);
  advance(*velocity, *velocity->start, step_size / 2.0);
}

void Integrator::correct(double step_size) {
  const bool midpoint = scheme_ == TimeScheme::midpoint && !stages_velocity();
  const bool by_passes = way_to_midpoint_ != nullptr;
  if (by_passes || midpoint) move_to_end(step_size);
  for (const Advanced& one : advanced_) {
    if (one.in_stages == nullptr || one.field == velocity_) continue;
    if (one.start != nullptr) advance(one, *one.start, 0.0);
    stages_.take(*one.in_stages, step_size);
  }
  for (Advanced& one : advanced_)
    advance_to_end(one, one.start == nullptr && one.predicted ? step_size / 2.0 : step_size);
  if (!by_passes && !midpoint) move_to_end(step_size);
  // Where passes advance the velocity, what it will be is found in the phase that follows: this is that of the
  // midpoint.
  if (by_passes) fastest_ = look_for_largest(state_.backend, *velocity_, state_.particles.count());
}

Motion Integrator::motion() {
  const auto root = [&](exec::Reduction found) { return std::sqrt(state_.backend.found(found)); };
  Motion motion;
  if (farthest_) {
    motion.farthest = root(*farthest_);
    state_.order.note_farthest(motion.farthest);
  }
  motion.finite = !farthest_ || std::isfinite(motion.farthest);
  for (Advanced& one : advanced_) {
    one.largest = root(one.found);
    const double rate = root(one.found.next());
    motion.finite = motion.finite && std::isfinite(one.largest) && std::isfinite(rate);
    if (one.field != velocity_) continue;
    motion.fastest = one.largest;
    motion.largest_acceleration = rate;
  }
  if (fastest_) motion.fastest = root(*fastest_);
  return motion;
}

template <class Real>
void Integrator::look(double step_size, Motion& motion) const {
  const Index count = state_.particles.count();
  const exec::Reduction change = state_.backend.fields<Real>().largest_change(
      std::as_const(*velocity_).view<Real>(device), std::as_const(*way_to_midpoint_).master(device), step_size,
      velocity_->components(), count);
  const exec::Reduction speed = look_for_largest(state_.backend, *velocity_, count);
  state_.wait();
  motion.fastest = std::sqrt(state_.backend.found(speed));
  motion.largest_acceleration = std::sqrt(state_.backend.found(change)) / step_size;
  motion.finite = motion.finite && std::isfinite(motion.fastest) && std::isfinite(motion.largest_acceleration);
}

void Integrator::look(double step_size, Motion& motion) const {
  dispatch(state_.scene.precision, [&]<class Real>() { look<Real>(step_size, motion); });
}

double Integrator::largest_acceleration() const {
  return largest_length(state_, acceleration_ == nullptr ? drive_ : acceleration_);
}

double Integrator::largest(std::string_view field) const {
  for (const Advanced& one : advanced_)
    if (one.field->name() == field) return one.largest;
  throw std::logic_error("'" + std::string(field) + "' is not advanced");
}

double Integrator::fastest() const { return largest_length(state_, velocity_); }

Integrator::Bad Integrator::find_bad() const {
  const auto bad_in = [&](const Field& field) {
    const FieldReader value = field.reader();
    for (Index i = 0; i < state_.particles.count(); ++i)
      for (int c = 0; c < field.components(); ++c)
        if (!(value(c, i) * value(c, i) <= most)) return i;
    return Index(-1);
  };
  for (const Advanced& one : advanced_)
    for (const Field* const field : {static_cast<const Field*>(one.rate), static_cast<const Field*>(one.field)})
      if (const Index i = bad_in(*field); i >= 0) return {field->name(), i};
  for (const Field* const field : {velocity_, shift_})
    if (field != nullptr)
      if (const Index i = bad_in(*field); i >= 0) return {field->name(), i};
  const auto position = exec::pointers(state_.particles.position, exec::Side::host);
  for (Index i = 0; i < state_.particles.count(); ++i)
    for (int d = 0; d < state_.scene.dimension; ++d)
      if (!(std::abs(position[d][i]) <= most)) return {"position", i};
  return {};
}

}  // namespace mesogen
