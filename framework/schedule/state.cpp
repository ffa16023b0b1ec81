#include "schedule/state.hpp"

namespace mesogen {

State::State(Scene scene_of_run, sph::SmoothingKernel kernel_of_run, const Boundary& boundary_of_run, Particles all,
             const Backend& backend_of_run)
    : scene(std::move(scene_of_run)),
      kernel(std::move(kernel_of_run)),
      boundary(boundary_of_run),
      backend(backend_of_run),
      particles(std::move(all)),
      neighbourhood(scene, boundary, backend),
      scratch_(backend.memory()),
      boundary_values_(scene, boundary, backend, neighbourhood, kernel) {}

Field& State::add_field(const std::string& name, int components, bool integrated) {
  Field& field = fields.add(std::make_unique<Field>(name, components, scene.precision, integrated, backend));
  field.resize(particles.count(), neighbourhood.boundary_count());
  return field;
}

Field& State::add_copy_in_double(const Field& of) {
  return add_in_double(of.name() + " at the start of the step", of.components());
}

Field& State::add_in_double(const std::string& name, int components) {
  Field& field = fields.add(std::make_unique<Field>(name, components, Precision::double_precision, true, backend));
  field.resize(particles.count(), neighbourhood.boundary_count());
  return field;
}

void State::resize_fields() {
  for (const auto& [name, field] : fields.all()) field->resize(particles.count(), neighbourhood.boundary_count());
}

void State::settle() {
  return_to_order();
  if (!moved_) return;
  moved_ = false;
  const Span span(sorting_, trace);
  const exec::Array<Index>* order = neighbourhood.update(particles);
  if (order != nullptr) permute_fields(*order);
  end_of_work();
}

void State::settle_for_reader() {
  if (!moved_) return;
  const Span span(sorting_, trace);
  if (!neighbourhood.update_without_sorting(particles)) {
    if (!kept_order_ && neighbourhood.sorted()) keep_order();
    const exec::Array<Index>& order = *neighbourhood.update(particles);
    if (kept_order_) {
      const auto from = order.host();
      const auto way_back = kept_order_->way_back.host(exec::Access::write);
      for (std::size_t n = 0; n < from.size(); ++n) way_back[static_cast<std::size_t>(from[n])] = static_cast<Index>(n);
    }
    permute_fields(order);
  }
  moved_ = false;
  end_of_work();
}

void State::keep_order() {
  kept_order_.emplace(Order{particles, {}, exec::Array<Index>(backend.memory())});
  kept_order_->way_back.resize_for_overwrite(particles.id.size());
  for (int d = 0; d < scene.dimension; ++d) {
    const auto sorted = neighbourhood.sorted_position()[d].host();
    kept_order_->sorted_position[d].assign(sorted.begin(), sorted.end());
  }
}

void State::return_to_order() {
  if (!kept_order_) return;
  const Span span(sorting_, trace);
  particles = kept_order_->particles;
  neighbourhood.restore(kept_order_->sorted_position);
  permute_fields(kept_order_->way_back);
  moved_ = true;
  kept_order_.reset();
  end_of_work();
}

void State::reorder() {
  return_to_order();
  const Span span(sorting_, trace);
  permute_fields(neighbourhood.reorder(particles));
  moved_ = true;
}

void State::permute_fields(const exec::Array<Index>& order) {
  ++positions_version_;
  resize_fields();
  for (const auto& [name, field] : fields.all()) {
    field->permute(order, scratch_);
    field->refreshed = 0;
  }
}

void State::sort_anew() {
  return_to_order();
  neighbourhood.forget_order();
  mark_moved();
  settle();
}

void State::restore_order(const std::array<std::vector<double>, 3>& sorted_position) {
  kept_order_.reset();
  mark_moved();
  neighbourhood.restore(sorted_position);
  resize_fields();
  for (const auto& [name, field] : fields.all()) field->refreshed = 0;
}

void State::refresh_boundary(Field& field) {
  if (boundary_values_.up_to_date(field)) return;
  const Span span(refreshing_, trace);
  boundary_values_.refresh(field);
  end_of_work();
}

}  // namespace mesogen
