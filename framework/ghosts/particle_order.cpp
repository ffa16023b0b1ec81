#include "ghosts/particle_order.hpp"

#include "particles/field_loops.hpp"

namespace mesogen {

template <class Real, template <class> class Arguments>
void ParticleOrder::move(const Arguments<Real>& arguments, double farthest) {
  mark_moved(farthest);
  moved_ = !neighbourhood_.move(arguments, farthest);
  if (moved_) clock_.backend.fields<Real>().move(arguments, particles_.count());
}
template MESOGEN_EXPORT void ParticleOrder::move(const exec::MoveArguments<float>&, double);
template MESOGEN_EXPORT void ParticleOrder::move(const exec::MoveArguments<double>&, double);
template MESOGEN_EXPORT void ParticleOrder::move(const exec::MoveByPassesArguments<float>&, double);
template MESOGEN_EXPORT void ParticleOrder::move(const exec::MoveByPassesArguments<double>&, double);

void ParticleOrder::settle() {
  return_to_integration();
  if (!moved_) return;
  moved_ = false;
  const Span span(sorting_, clock_.trace);
  if (!neighbourhood_.update(particles_, farthest_)) {
    travel();
    permute_fields(neighbourhood_.sort(particles_));
  }
  clock_.end_of_work();
}

void ParticleOrder::settle_for_reader() {
  if (!moved_) return;
  const Span span(sorting_, clock_.trace);
  if (!neighbourhood_.update(particles_, farthest_)) {
    if (!kept_ && neighbourhood_.sorted()) keep();
    travel();
    const exec::Array<Index>& order = neighbourhood_.sort(particles_);
    if (kept_) {
      kept_->way_back.resize_for_overwrite(order.size());
      const auto from = order.host();
      const auto way_back = kept_->way_back.host(exec::Access::write);
      for (std::size_t n = 0; n < from.size(); ++n) way_back[static_cast<std::size_t>(from[n])] = static_cast<Index>(n);
    }
    permute_fields(order);
  }
  moved_ = false;
  clock_.end_of_work();
}

void ParticleOrder::keep() {
  kept_.emplace(Kept{particles_, {}, exec::Array<Index>(clock_.backend.memory()), {}});
  for (int d = 0; d < particles_.dimension; ++d) {
    const auto sorted = neighbourhood_.sorted_position()[d].host();
    kept_->sorted_position[d].assign(sorted.begin(), sorted.end());
  }
}

void ParticleOrder::return_to_integration() {
  if (!kept_) return;
  const Span span(sorting_, clock_.trace);
  permute(kept_->way_back);
  if (kept_->journey) carry_fields(*kept_->journey, true);
  particles_ = kept_->particles;
  neighbourhood_.restore(particles_, kept_->sorted_position);
  changed_places();
  moved_ = true;
  farthest_ = nobody_knows;
  kept_.reset();
  clock_.end_of_work();
}

void ParticleOrder::sort_for_memory() {
  return_to_integration();
  const Span span(sorting_, clock_.trace);
  travel();
  permute_fields(neighbourhood_.reorder(particles_));
  moved_ = true;
  farthest_ = nobody_knows;
  clock_.end_of_work();
}

void ParticleOrder::sort_anew() {
  return_to_integration();
  neighbourhood_.forget_order();
  mark_moved();
  settle();
}

void ParticleOrder::restore(const std::array<std::vector<double>, 3>& sorted_position) {
  kept_.reset();
  mark_moved();
  neighbourhood_.restore(particles_, sorted_position);
  resize_fields();
  for (const auto& [name, field] : fields_.all()) field->refreshed = 0;
}

// Brings particles to the ranks that they belong to. A reader's sorting moves no borders: it leaves no trace.
void ParticleOrder::travel() {
  if (!ranks_.several()) return;
  Journey journey(ranks_, neighbourhood_.owners(particles_, !kept_));
  if (!journey.anybody()) return;
  const auto carried = [&](auto& array) { array.assign(journey.carry(array.host())); };
  carried(particles_.id);
  for (int d = 0; d < particles_.dimension; ++d) {
    carried(particles_.position[d]);
    carried(particles_.images[d]);
  }
  carry_fields(journey, false);
  if (kept_) kept_->journey.emplace(std::move(journey));
}

void ParticleOrder::carry_fields(const Journey& journey, bool back) {
  for (const auto& [name, field] : fields_.all())
    if (!field->follows_positions) field->carry(journey, back);
}

void ParticleOrder::permute(const exec::Array<Index>& order) {
  for (const auto& [name, field] : fields_.all())
    if (!field->follows_positions) field->permute(order, scratch_);
}

void ParticleOrder::permute_fields(const exec::Array<Index>& order) {
  changed_places();
  permute(order);
}

// Values of ghosts and walls are lost.
void ParticleOrder::changed_places() {
  ++version_;
  resize_fields();
  for (const auto& [name, field] : fields_.all()) field->refreshed = 0;
}

void ParticleOrder::resize_fields() {
  for (const auto& [name, field] : fields_.all()) field->resize(particles_.count(), neighbourhood_.boundary_count());
}

}  // namespace mesogen
