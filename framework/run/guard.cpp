#include "run/guard.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/exec/dispatch.hpp"
#include "particles/field_loops.hpp"
#include "run/closest_pair.hpp"
#include "sph/lattice.hpp"
#include "text/rounded_text.hpp"

namespace mesogen {

namespace {

// How far a particle may go in one step, in spacings, before the run has plainly run away.
double farthest(const Scene& scene) { return scene.stabilised_steps ? 1.0 : 0.5; }

// The automatic step follows a flow that runs away and would never let it arrive: it is given up when motion asks for
// steps this much shorter than the plugins' limits.
constexpr double shortest = 1e-3;

// Volumes over that of the lattice. A particle of twice the volume has lost half of its neighbours to a void; where
// three stand in the place of one it has a third. Random starts come down to 0.47 (a jitter of half a spacing), and
// spread.
constexpr double smallest_volume = 1.0 / 3.0;
constexpr double largest_volume = 2.0;

// Two particles nearer than this, in spacings, see the same neighbours and stay together for good: one of them is lost.
// A pair hardly shows in the volumes, so pairs are looked for by themselves; that costs about as much as a tenth of a
// step, so it is done now and then.
constexpr double nearest = 0.1;
constexpr std::int64_t steps_between_looks = 128;

double length_of(const FieldReader& value, int components, Index i) {
  if (components == 1) return value(0, i);
  double square = 0.0;
  for (int c = 0; c < components; ++c) square += value(c, i) * value(c, i);
  return std::sqrt(square);
}

struct Farthest {
  Index place = 0;
  double excess = 0.0;
};

/// The particle that is farthest outside; what is not a number is farther than anything.
Farthest farthest_outside(const Field& field, Index count, double lowest, double highest) {
  Farthest worst;
  double most = -HUGE_VAL;
  const FieldReader reader = field.reader();
  for (Index i = 0; i < count; ++i) {
    const double value = length_of(reader, field.components(), i);
    const double excess = std::isnan(value) ? HUGE_VAL : std::max(lowest - value, value - highest);
    if (excess > most) {
      most = excess;
      worst = {i, std::max(excess, 0.0)};
    }
  }
  return worst;
}

// Looks at the numbers that passes see: half as many bytes as the doubles of an advanced field.
template <class Real>
exec::Reduction look_outside(const State& state, const Field& field, double lowest, double highest) {
  return state.backend.fields<Real>().is_outside(field.view<Real>(exec::Side::device), field.components(),
                                                 state.particles.count(), lowest, highest);
}

exec::Reduction look_outside(const State& state, const Field& field, double lowest, double highest) {
  return dispatch(state.scene.precision,
                  [&]<class Real>() { return look_outside<Real>(state, field, lowest, highest); });
}

// On a lattice of as many particles as the box holds.
double volume_on_lattice(const State& state) {
  const int dimension = state.scene.dimension;
  const double filled = state.scene.fluid_volume / static_cast<double>(state.scene.particle_count);
  return sph::volume_on_lattice(state.kernel, std::pow(filled, 1.0 / dimension), dimension);
}

}  // namespace

Guard::Guard(State& state, const Catalogue& catalogue, const StepGraph& graph, const Integrator& integrator,
             const StepControl& control)
    : state_(state), integrator_(integrator), control_(control), lattice_volume_(volume_on_lattice(state)) {
  // What is made for observers alone is out of date, or was never made.
  const auto made_at_each_step = [&](const std::string& field) {
    return std::any_of(graph.passes().begin(), graph.passes().end(), [&](const ScheduledPass& scheduled) {
      const auto& written = scheduled.pass.write_list;
      const auto& added = scheduled.pass.accumulate_list;
      return scheduled.for_integration && (std::find(written.begin(), written.end(), field) != written.end() ||
                                           std::find(added.begin(), added.end(), field) != added.end());
    });
  };
  const auto read_at_each_step = [&](const std::string& field) {
    return std::ranges::any_of(graph.passes(), [&](const ScheduledPass& scheduled) {
      const Pass& pass = scheduled.pass;
      return scheduled.for_integration &&
             std::ranges::any_of(std::array{&pass.own_reads, &pass.neighbour_reads, &pass.optional_reads},
                                 [&](const auto* list) { return std::ranges::find(*list, field) != list->end(); });
    });
  };
  const auto up_to_date = [&](const std::string& field) {
    return catalogue.is_state(field) || made_at_each_step(field) ||
           (catalogue.is_prescribed(field) && read_at_each_step(field));
  };
  for (const auto& [name, entry] : catalogue.all())
    if (entry.declaration.bounds && up_to_date(name))
      fields_.push_back({&state.fields.at(name), *entry.declaration.bounds, entry.prescribed});
  looks_for_pairs_ = integrator.moves() && graph.sums_pairs();
  if (integrator.moves() && !graph.derived_for_integration().empty()) volume_ = &state.fields.at("volume");
}

void Guard::look() {
  outside_.clear();
  for (const auto& [field, bounds, prescribed] : fields_)
    outside_.push_back(look_outside(state_, *field, bounds.lowest, bounds.highest));
  if (volume_ != nullptr)
    outside_.push_back(
        look_outside(state_, *volume_, smallest_volume * lattice_volume_, largest_volume * lattice_volume_));
}

void Guard::check(const Motion& motion) const {
  if (!motion.finite) check_prescribed();
  check_finite(motion);
  check_speed(motion);
  check_step(motion);
  const auto is_outside = [&](std::size_t n) { return state_.backend.found(outside_[n]) > 0.0; };
  for (std::size_t n = 0; n < fields_.size(); ++n)
    if (is_outside(n)) stop_at_field(fields_[n]);
  if (volume_ != nullptr && is_outside(fields_.size())) stop_at_volume();
  if (looks_for_pairs_ && state_.step % steps_between_looks == 0) check_distances();
}

// What the case gives is the cause of what comes of it.
void Guard::check_prescribed() const {
  for (const Guarded& guarded : fields_) {
    if (!guarded.prescribed) continue;
    const exec::Reduction outside = look_outside(state_, *guarded.field, guarded.bounds.lowest, guarded.bounds.highest);
    state_.wait();
    if (state_.backend.found(outside) > 0.0) stop_at_field(guarded);
  }
}

void Guard::check_finite(const Motion& motion) const {
  if (motion.finite) return;
  const auto bad = integrator_.find_bad();
  stop("broke down: '" + bad.field + "' is not finite" + (bad.particle >= 0 ? " at " + particle(bad.particle) : ""),
       calmer(), bad.field.empty() ? 0.0 : 1.0);
}

void Guard::check_speed(const Motion& motion) const {
  const double most = farthest(state_.scene);
  if (!(motion.fastest * state_.step_size > most * state_.scene.spacing)) return;
  const auto [place, speed] = farthest_outside(*integrator_.velocity(), state_.particles.count(), 0.0, 0.0);
  stop("ran away: the largest speed, " + rounded_text(motion.fastest) + " " + unit("m/s") + " of " + particle(place) +
           ", carries it over " + rounded_text(most) + (most == 1.0 ? " spacing" : " spacings") + " in one step",
       calmer(), speed);
}

void Guard::check_step(const Motion& motion) const {
  if (control_.fixed() || !std::isfinite(control_.at_rest())) return;
  const StepControl::Choice choice = control_.choose(motion.fastest, motion.largest_acceleration);
  const double next = choice.seconds;
  if (!(next < shortest * control_.at_rest())) return;
  const Index count = state_.particles.count();
  const auto largest = [&](const Field* field, double value, const std::string& unit) {
    return rounded_text(value) + " " + unit + " of " + particle(farthest_outside(*field, count, 0.0, 0.0).place);
  };
  const std::string acceleration =
      integrator_.acceleration() == nullptr ? ""
      // The rank that has the fastest particle tells of it; the other may be another's.
      : state_.ranks.several()
          ? ", and acceleration, " + rounded_text(motion.largest_acceleration) + " " + unit("m/s2")
          : ", and acceleration, " + largest(integrator_.acceleration(), motion.largest_acceleration, unit("m/s2"));
  const std::string ask = acceleration.empty() ? "asks" : "ask";
  stop("ran away: the largest speed, " + largest(integrator_.velocity(), motion.fastest, unit("m/s")) + acceleration +
           ", " + ask + " for steps of " + rounded_text(next) + " " + unit("s") + " (" + choice.limit +
           "), where the fluid at rest allows " + rounded_text(control_.at_rest()) + " " + unit("s"),
       "If the flow is meant to be so fast, give the step by time.step",
       farthest_outside(*integrator_.velocity(), count, 0.0, 0.0).excess);
}

void Guard::stop_at_field(const Guarded& guarded) const {
  const auto& [field, bounds, prescribed] = guarded;
  const auto [place, excess] = farthest_outside(*field, state_.particles.count(), bounds.lowest, bounds.highest);
  stop("broke down: '" + field->name() + "' is " +
           (state_.particles.count() == 0 ? "" : rounded_text(length_of(field->reader(), field->components(), place))) +
           " at " + particle(place) + ", outside " + rounded_text(bounds.lowest) + " to " +
           rounded_text(bounds.highest) + ",",
       bounds.remedy, excess);
}

void Guard::stop_at_volume() const {
  const auto [place, excess] = farthest_outside(*volume_, state_.particles.count(), smallest_volume * lattice_volume_,
                                                largest_volume * lattice_volume_);
  const double ratio = state_.particles.count() == 0 ? 0.0 : volume_->value(0, place) / lattice_volume_;
  stop("broke down: the volume of " + particle(place) + " is " + rounded_text(ratio) +
           " times that on a lattice, outside " + rounded_text(smallest_volume) + " to " +
           rounded_text(largest_volume) + ": " +
           (ratio > 1.0 ? "particles have left a void there" : "particles have gathered there") + ",",
       calmer(), excess);
}

void Guard::check_distances() const {
  const auto found = closest_pair(state_, nearest * state_.scene.spacing);
  if (!any(state_.ranks, found.has_value())) return;
  ClosestPair pair = found.value_or(ClosestPair{});
  if (id_at(pair.b) < id_at(pair.a)) std::swap(pair.a, pair.b);
  const double apart = pair.distance / state_.scene.spacing;
  stop("broke down: " + particle(pair.a) + " and " + particle(pair.b) + " are " + rounded_text(apart) +
           " spacings apart, less than " + rounded_text(nearest) + ",",
       calmer(), found ? nearest / std::max(apart, 1e-300) : 0.0);
}

std::string Guard::calmer() const {
  const std::string step =
      control_.fixed() ? "ake a smaller time.step, or leave it to \"auto\"" : "ake a smaller step (time.factor = 0.5)";
  return looks_for_pairs_ ? "Leave the shift of the flow at its default, or t" + step : "T" + step;
}

// A place beyond the ghosts is that of a particle of another rank.
std::int64_t Guard::id_at(Index place) const {
  const Index count = state_.particles.count();
  if (place >= 0 && place < count) return state_.particles.id.host()[static_cast<std::size_t>(place)];
  const GhostView ghosts = state_.neighbourhood.ghost_view(exec::Side::host);
  const Index of_others = place - (ghosts.first + ghosts.count);
  const std::vector<std::int64_t>& ids = state_.neighbourhood.halo().ids();
  return place < 0 || of_others < 0 || of_others >= std::ssize(ids) ? -1 : ids[static_cast<std::size_t>(of_others)];
}

std::string Guard::particle(Index place) const {
  const std::int64_t id = id_at(place);
  if (id < 0) return "no particle";  // of a rank that has none: another one tells
  const GhostView ghosts = state_.neighbourhood.ghost_view(exec::Side::host);
  const bool own = place < state_.particles.count();
  std::array<double, 3> at{};
  std::array<std::int32_t, 3> images{};
  for (int d = 0; d < state_.scene.dimension; ++d)
    at[d] = own ? state_.particles.position[d].host()[static_cast<std::size_t>(place)]
                : ghosts.of_others[d][place - (ghosts.first + ghosts.count)];
  state_.boundary.keep_inside(state_.scene, at.data(), images.data());
  std::string text = "particle " + std::to_string(id) + " (";
  for (int d = 0; d < state_.scene.dimension; ++d) text += (d > 0 ? ", " : "") + rounded_text(at[d]);
  return text + ")";
}

// All ranks come here at the same step, and all throw what the one says that has the worst particle.
void Guard::stop(const std::string& what, const std::string& remedy, double excess) const {
  throw Error(ExitCode::run_failed,
              text_of_worst(state_.ranks, excess,
                            "the run " + what + " at t = " + rounded_text(state_.time) + " " + unit("s") + " (step " +
                                std::to_string(state_.step) + ", step size " + rounded_text(state_.step_size) + " " +
                                unit("s") + "). " + remedy + "; the frames before are kept"));
}

}  // namespace mesogen
