#include "time/integrator.hpp"

#include <algorithm>
#include <cmath>

namespace mesogen {

namespace {

// Largest squared length of a vector; infinite if a component is not a number.
template <class T>
double largest_square(const FieldView<T>& field, int components, Index count) {
  double largest = 0.0;
#pragma omp parallel for schedule(static) reduction(max : largest)
  for (Index i = 0; i < count; ++i) {
    double square = 0.0;
    for (int c = 0; c < components; ++c) {
      const auto value = static_cast<double>(field(c, i));
      square += value * value;
    }
    largest = std::max(largest, std::isfinite(square) ? square : HUGE_VAL);
  }
  return largest;
}

double largest_length(Field* field, Index count) {
  if (field == nullptr) return 0.0;
  return std::sqrt(field->is_double() ? largest_square(field->view<double>(), field->components(), count)
                                      : largest_square(field->view<float>(), field->components(), count));
}

}  // namespace

Integrator::Integrator(World& world, const Catalogue& catalogue, const std::string& velocity, const std::string& shift)
    : world_(world) {
  for (const auto& [name, entry] : catalogue.all()) {
    if (entry.declaration.advance == Advance::never) continue;
    advanced_.push_back({&world.fields.at(name), &world.fields.at(entry.declaration.rate),
                         entry.declaration.advance == Advance::predicted});
    if (name == velocity) acceleration_ = advanced_.back().rate;
  }
  if (!velocity.empty()) velocity_ = &world.fields.at(velocity);
  if (!shift.empty()) shift_ = &world.fields.at(shift);
}

template <class Real>
void Integrator::advance(const Advanced& one, double by) {
  const Index count = world_.particles.count();
  const FieldView<double> master = one.field->master();
  const FieldView<Real> seen = one.field->view<Real>();
  const FieldView<Real> rate = one.rate->view<Real>();
  for (int c = 0; c < one.field->components(); ++c) {
    double* const exact = master.component(c);
    Real* const rounded = seen.component(c);
    const Real* const slope = rate.component(c);
#pragma omp parallel for schedule(static)
    for (Index i = 0; i < count; ++i) {
      exact[i] += by * static_cast<double>(slope[i]);
      rounded[i] = static_cast<Real>(exact[i]);
    }
  }
  ++one.field->version;
}

void Integrator::advance(const Advanced& one, double by) {
  if (world_.single()) {
    advance<float>(one, by);
  } else {
    advance<double>(one, by);
  }
}

template <class Real>
void Integrator::move(double by, double shift_by) {
  const Index count = world_.particles.count();
  const FieldView<double> velocity = velocity_->master();
  const FieldView<Real> shift = shift_ == nullptr ? FieldView<Real>{} : shift_->view<Real>();
  for (int d = 0; d < world_.scene.dimension; ++d) {
    double* const position = world_.particles.position[d].data();
    const double* const u = velocity.component(d);
    const Real* const s = shift_ == nullptr || shift_by == 0.0 ? nullptr : shift.component(d);
#pragma omp parallel for schedule(static)
    for (Index i = 0; i < count; ++i)
      position[i] += by * u[i] + (s == nullptr ? 0.0 : shift_by * static_cast<double>(s[i]));
  }
}

void Integrator::move(double by, double shift_by) {
  if (velocity_ == nullptr) return;
  if (world_.single()) {
    move<float>(by, shift_by);
  } else {
    move<double>(by, shift_by);
  }
  world_.mark_moved();
}

void Integrator::predict(double step_size) {
  for (const Advanced& one : advanced_)
    if (one.predicted) advance(one, step_size / 2.0);
  move(step_size / 2.0, 0.0);
}

Motion Integrator::correct(double step_size) {
  for (const Advanced& one : advanced_) advance(one, one.predicted ? step_size / 2.0 : step_size);
  Motion motion;
  motion.largest_acceleration = largest_acceleration();
  motion.fastest = fastest();
  for (const Advanced& one : advanced_)
    if (one.field != velocity_ && !std::isfinite(largest_length(one.field, world_.particles.count())))
      motion.finite = false;
  motion.finite = motion.finite && std::isfinite(motion.fastest) && std::isfinite(motion.largest_acceleration);
  if (motion.finite) move(step_size / 2.0, step_size);
  return motion;
}

double Integrator::largest_acceleration() const { return largest_length(acceleration_, world_.particles.count()); }

double Integrator::fastest() const { return largest_length(velocity_, world_.particles.count()); }

Integrator::Bad Integrator::find_bad() const {
  const auto bad_in = [&](const Field& field) {
    for (Index i = 0; i < world_.particles.count(); ++i)
      for (int c = 0; c < field.components(); ++c)
        if (!std::isfinite(field.value(c, i))) return i;
    return Index(-1);
  };
  for (const Advanced& one : advanced_)
    for (const Field* const field : {static_cast<const Field*>(one.rate), static_cast<const Field*>(one.field)})
      if (const Index i = bad_in(*field); i >= 0) return {field->name(), i};
  return {};
}

}  // namespace mesogen
