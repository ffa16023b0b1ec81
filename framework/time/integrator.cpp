#include "time/integrator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "mesogen/exec/blocks.hpp"

namespace mesogen {

namespace {

constexpr double most = std::numeric_limits<double>::max();

// Largest squared length of a vector; infinite if a component is not a number.
template <class T>
double largest_square(const FieldView<T>& field, int components, Index count) {
  double largest = 0.0;
  const exec::Blocks blocks(count);
#pragma omp parallel for schedule(static) reduction(max : largest)
  for (Index block = 0; block < blocks.number(); ++block) {
    for (Index i = blocks.begin(block); i < blocks.end(block); ++i) {
      double square = 0.0;
      for (int c = 0; c < components; ++c) {
        const auto value = static_cast<double>(field(c, i));
        square += value * value;
      }
      largest = square <= most ? std::max(largest, square) : HUGE_VAL;
    }
  }
  return largest;
}

double largest_length(Field* field, Index count) {
  if (field == nullptr) return 0.0;
  // Of an advanced field the doubles: what a step found must be found again when a run is resumed.
  if (field->is_double() || field->integrated())
    return std::sqrt(largest_square(field->master(), field->components(), count));
  return std::sqrt(largest_square(field->view<float>(), field->components(), count));
}

}  // namespace

Integrator::Integrator(World& world, const Catalogue& catalogue, const Transport& transport, TimeScheme scheme)
    : world_(world), scheme_(scheme), fixed_(transport.fixed) {
  for (const auto& [name, entry] : catalogue.all()) {
    if (!has_rate(entry.declaration.advance)) continue;
    Field& field = world.fields.at(name);
    Advanced one{&field, &world.fields.at(entry.declaration.rate), entry.declaration.advance == Advance::predicted,
                 nullptr};
    if (one.predicted && scheme == TimeScheme::midpoint) one.start = &world.add_copy_in_double(field);
    advanced_.push_back(one);
    if (name == transport.velocity) acceleration_ = one.rate;
  }
  if (!transport.velocity.empty()) velocity_ = &world.fields.at(transport.velocity);
  if (!transport.shift.empty()) shift_ = &world.fields.at(transport.shift);
  if (velocity_ != nullptr && acceleration_ == nullptr && !fixed_)
    way_to_midpoint_ = &world.add_in_double("way to the midpoint", velocity_->components());
  if (!transport.drive.empty()) drive_ = world.fields.find(transport.drive);
}

template <class Real, int Components>
Integrator::Largest Integrator::advance(const Advanced& one, Field& from, double by) {
  const Index count = world_.particles.count();
  const FieldView<double> before = from.master();
  const FieldView<double> exact = one.field->master();
  const FieldView<Real> rounded = one.field->view<Real>();
  const FieldView<Real> rate = one.rate->view<Real>();
  double largest_value = 0.0;
  double largest_rate = 0.0;
  const exec::Blocks blocks(count);
#pragma omp parallel for schedule(static) reduction(max : largest_value, largest_rate)
  for (Index block = 0; block < blocks.number(); ++block) {
    for (Index i = blocks.begin(block); i < blocks.end(block); ++i) {
      double value_square = 0.0;
      double rate_square = 0.0;
      for (int c = 0; c < Components; ++c) {
        const auto slope = static_cast<double>(rate(c, i));
        const double value = before(c, i) + by * slope;
        exact(c, i) = value;
        rounded(c, i) = static_cast<Real>(value);
        value_square += value * value;
        rate_square += slope * slope;
      }
      // A comparison with NaN is false: what is not a number counts as infinite.
      largest_value = value_square <= most ? std::max(largest_value, value_square) : HUGE_VAL;
      largest_rate = rate_square <= most ? std::max(largest_rate, rate_square) : HUGE_VAL;
    }
  }
  ++one.field->version;
  return {std::sqrt(largest_value), std::sqrt(largest_rate)};
}

template <class Real>
Integrator::Largest Integrator::advance(const Advanced& one, Field& from, double by) {
  switch (one.field->components()) {
    case 1: return advance<Real, 1>(one, from, by);
    case 2: return advance<Real, 2>(one, from, by);
    case 3: return advance<Real, 3>(one, from, by);
    case 4: return advance<Real, 4>(one, from, by);
    case 5: return advance<Real, 5>(one, from, by);
    case 9: return advance<Real, 9>(one, from, by);
    default: throw std::logic_error("'" + one.field->name() + "' has a number of components that no rank has");
  }
}

Integrator::Largest Integrator::advance(const Advanced& one, Field& from, double by) {
  return world_.single() ? advance<float>(one, from, by) : advance<double>(one, from, by);
}

template <class Real>
bool Integrator::move(double by, double shift_by) {
  const exec::Blocks blocks(world_.particles.count());
  int bad = 0;
  const FieldView<double> velocity = velocity_->master();
  const FieldView<Real> shift = shift_ == nullptr ? FieldView<Real>{} : shift_->view<Real>();
  for (int d = 0; d < world_.scene.dimension; ++d) {
    double* const position = world_.particles.position[d].data();
    const double* const u = velocity.component(d);
    const Real* const s = shift_ == nullptr || shift_by == 0.0 ? nullptr : shift.component(d);
#pragma omp parallel for schedule(static) reduction(| : bad)
    for (Index block = 0; block < blocks.number(); ++block) {
      for (Index i = blocks.begin(block); i < blocks.end(block); ++i) {
        position[i] += by * u[i] + (s == nullptr ? 0.0 : shift_by * static_cast<double>(s[i]));
        bad |= static_cast<int>(!(std::abs(position[i]) <= most));
      }
    }
  }
  return bad == 0;
}

bool Integrator::move(double by, double shift_by) {
  if (velocity_ == nullptr || fixed_) return true;
  world_.mark_moved();
  return world_.single() ? move<float>(by, shift_by) : move<double>(by, shift_by);
}

void Integrator::predict(double step_size) {
  for (const Advanced& one : advanced_) {
    if (!one.predicted) continue;
    if (one.start != nullptr) one.start->copy_master(*one.field);
    advance(one, *one.field, step_size / 2.0);
  }
  if (way_to_midpoint_ == nullptr) {
    move(step_size / 2.0, 0.0);
  } else {
    world_.mark_moved();
    world_.single() ? move_by_passes<float>(step_size, true) : move_by_passes<double>(step_size, true);
  }
}

template <class Real>
bool Integrator::move_by_passes(double step_size, bool to_midpoint) {
  const exec::Blocks blocks(world_.particles.count());
  int bad = 0;
  const FieldView<Real> velocity = velocity_->view<Real>();
  for (int d = 0; d < world_.scene.dimension; ++d) {
    double* const position = world_.particles.position[d].data();
    double* const way = way_to_midpoint_->master().component(d);
    const Real* const u = velocity.component(d);
    const Real* const s = shift_ == nullptr || to_midpoint ? nullptr : shift_->view<Real>().component(d);
#pragma omp parallel for schedule(static) reduction(| : bad)
    for (Index block = 0; block < blocks.number(); ++block) {
      for (Index i = blocks.begin(block); i < blocks.end(block); ++i) {
        if (to_midpoint) {
          way[i] = step_size / 2.0 * static_cast<double>(u[i]);
          position[i] += way[i];
        } else {
          const double speed = static_cast<double>(u[i]) + (s == nullptr ? 0.0 : static_cast<double>(s[i]));
          position[i] += step_size * speed - way[i];
        }
        bad |= static_cast<int>(!(std::abs(position[i]) <= most));
      }
    }
  }
  return bad == 0;
}

Motion Integrator::correct(double step_size) {
  if (way_to_midpoint_ != nullptr) return correct_by_passes(step_size);
  Motion motion;
  const bool midpoint = scheme_ == TimeScheme::midpoint;
  if (midpoint) motion.finite = move(step_size / 2.0, step_size);
  advance_fields(step_size, motion);
  if (motion.finite && !midpoint) motion.finite = move(step_size / 2.0, step_size);
  return motion;
}

// What the velocity will be is found in the phase that follows: the largest is that of the midpoint.
Motion Integrator::correct_by_passes(double step_size) {
  Motion motion;
  world_.mark_moved();
  motion.finite = world_.single() ? move_by_passes<float>(step_size, false) : move_by_passes<double>(step_size, false);
  advance_fields(step_size, motion);
  motion.fastest = fastest();
  return motion;
}

void Integrator::advance_fields(double step_size, Motion& motion) {
  const bool midpoint = scheme_ == TimeScheme::midpoint;
  for (const Advanced& one : advanced_) {
    Field& from = one.start != nullptr ? *one.start : *one.field;
    const Largest largest = advance(one, from, one.predicted && !midpoint ? step_size / 2.0 : step_size);
    motion.finite = motion.finite && std::isfinite(largest.value) && std::isfinite(largest.rate);
    if (one.field != velocity_) continue;
    motion.fastest = largest.value;
    motion.largest_acceleration = largest.rate;
  }
}

template <class Real>
void Integrator::look(double step_size, Motion& motion) const {
  const Index count = world_.particles.count();
  const int axes = velocity_->components();
  const FieldView<Real> velocity = velocity_->view<Real>();
  const FieldView<double> way = way_to_midpoint_->master();
  const exec::Blocks blocks(count);
  double largest = 0.0;
#pragma omp parallel for schedule(static) reduction(max : largest)
  for (Index block = 0; block < blocks.number(); ++block) {
    for (Index i = blocks.begin(block); i < blocks.end(block); ++i) {
      double square = 0.0;
      for (int c = 0; c < axes; ++c)
        square += std::pow(static_cast<double>(velocity(c, i)) - 2.0 / step_size * way(c, i), 2);
      largest = square <= most ? std::max(largest, square) : HUGE_VAL;
    }
  }
  motion.fastest = fastest();
  motion.largest_acceleration = std::sqrt(largest) / step_size;
  motion.finite = motion.finite && std::isfinite(motion.fastest) && std::isfinite(largest);
}

void Integrator::look(double step_size, Motion& motion) const {
  world_.single() ? look<float>(step_size, motion) : look<double>(step_size, motion);
}

double Integrator::largest_acceleration() const {
  return largest_length(acceleration_ == nullptr ? drive_ : acceleration_, world_.particles.count());
}

double Integrator::fastest() const { return largest_length(velocity_, world_.particles.count()); }

Integrator::Bad Integrator::find_bad() const {
  const auto bad_in = [&](const Field& field) {
    for (Index i = 0; i < world_.particles.count(); ++i)
      for (int c = 0; c < field.components(); ++c)
        if (!(field.value(c, i) * field.value(c, i) <= most)) return i;
    return Index(-1);
  };
  for (const Advanced& one : advanced_)
    for (const Field* const field : {static_cast<const Field*>(one.rate), static_cast<const Field*>(one.field)})
      if (const Index i = bad_in(*field); i >= 0) return {field->name(), i};
  for (const Field* const field : {velocity_, shift_})
    if (field != nullptr)
      if (const Index i = bad_in(*field); i >= 0) return {field->name(), i};
  for (Index i = 0; i < world_.particles.count(); ++i)
    for (int d = 0; d < world_.scene.dimension; ++d)
      if (!(std::abs(world_.particles.position[d][i]) <= most)) return {"position", i};
  return {};
}

}  // namespace mesogen
