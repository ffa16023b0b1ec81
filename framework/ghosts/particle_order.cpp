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
  const exec::Array<Index>* order = neighbourhood_.update(particles_, farthest_);
  if (order != nullptr) permute_fields(*order);
  clock_.end_of_work();
}

void ParticleOrder::settle_for_reader() {
  if (!moved_) return;
  const Span span(sorting_, clock_.trace);
  if (!neighbourhood_.update_without_sorting(particles_, farthest_)) {
    if (!kept_ && neighbourhood_.sorted()) keep();
    const exec::Array<Index>& order = *neighbourhood_.update(particles_, farthest_);
    if (kept_) {
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
  kept_.emplace(Kept{particles_, {}, exec::Array<Index>(clock_.backend.memory())});
  kept_->way_back.resize_for_overwrite(particles_.id.size());
  for (int d = 0; d < particles_.dimension; ++d) {
    const auto sorted = neighbourhood_.sorted_position()[d].host();
    kept_->sorted_position[d].assign(sorted.begin(), sorted.end());
  }
}

void ParticleOrder::return_to_integration() {
  if (!kept_) return;
  const Span span(sorting_, clock_.trace);
  particles_ = kept_->particles;
  neighbourhood_.restore(kept_->sorted_position);
  permute_fields(kept_->way_back);
  moved_ = true;
  farthest_ = nobody_knows;
  kept_.reset();
  clock_.end_of_work();
}

void ParticleOrder::sort_for_memory() {
  return_to_integration();
  const Span span(sorting_, clock_.trace);
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
  neighbourhood_.restore(sorted_position);
  resize_fields();
  for (const auto& [name, field] : fields_.all()) field->refreshed = 0;
}

void ParticleOrder::permute_fields(const exec::Array<Index>& order) {
  ++version_;
  resize_fields();
  for (const auto& [name, field] : fields_.all()) {
    if (!field->follows_positions) field->permute(order, scratch_);
    field->refreshed = 0;
  }
}

void ParticleOrder::resize_fields() {
  for (const auto& [name, field] : fields_.all()) field->resize(particles_.count(), neighbourhood_.boundary_count());
}

}  // namespace mesogen
