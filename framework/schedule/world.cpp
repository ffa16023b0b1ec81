#include "schedule/world.hpp"

namespace mesogen {

World::World(Scene scene_of_run, sph::SmoothingKernel kernel_of_run, const Boundary& boundary_of_run, Particles all)
    : scene(std::move(scene_of_run)),
      kernel(std::move(kernel_of_run)),
      boundary(boundary_of_run),
      particles(std::move(all)),
      neighbourhood(scene, boundary) {}

Field& World::add_field(const std::string& name, int components, bool integrated) {
  Field& field = fields.add(std::make_unique<Field>(name, components, scene.precision, integrated));
  field.resize(particles.count(), neighbourhood.outside_count());
  return field;
}

Field& World::add_copy_in_double(const Field& of) {
  return add_in_double(of.name() + " at the start of the step", of.components());
}

Field& World::add_in_double(const std::string& name, int components) {
  Field& field = fields.add(std::make_unique<Field>(name, components, Precision::double_precision, true));
  field.resize(particles.count(), neighbourhood.outside_count());
  return field;
}

void World::resize_fields() {
  for (const auto& [name, field] : fields.all()) field->resize(particles.count(), neighbourhood.outside_count());
}

void World::settle() {
  if (!moved_) return;
  moved_ = false;
  const Span span(sorting_, trace);
  const std::vector<Index>* order = neighbourhood.update(particles);
  if (order != nullptr) permute_fields(*order);
}

void World::reorder() {
  const Span span(sorting_, trace);
  permute_fields(neighbourhood.reorder(particles));
  moved_ = true;
}

void World::permute_fields(const std::vector<Index>& order) {
  ++positions_version_;
  resize_fields();
  for (const auto& [name, field] : fields.all()) {
    field->permute(order, scratch_);
    field->refreshed = 0;
  }
}

void World::sort_anew() {
  neighbourhood.forget_order();
  mark_moved();
  settle();
}

void World::restore_order(std::array<std::vector<double>, 3> sorted_position) {
  mark_moved();
  neighbourhood.restore(particles, std::move(sorted_position));
  resize_fields();
  for (const auto& [name, field] : fields.all()) field->refreshed = 0;
}

void World::refresh_outside(Field& field) {
  if (neighbourhood.outside_count() == 0) return;
  const bool walls = !neighbourhood.dummies().position.empty();
  // Where particles moved, other ones stand before the wall; a copy's values are its source's wherever that is.
  const std::uint64_t positions = walls ? neighbourhood.version() : 0;
  if (field.refreshed == field.version && field.refreshed_at == positions) return;
  const Span span(refreshing_, trace);
  if (walls) {
    walls_.refresh(neighbourhood, scene, kernel, boundary, field);
  } else if (single()) {
    boundary.refresh(neighbourhood.copies(), field.view<float>(), field.components(), particles.count());
  } else {
    boundary.refresh(neighbourhood.copies(), field.view<double>(), field.components(), particles.count());
  }
  field.refreshed = field.version;
  field.refreshed_at = positions;
}

}  // namespace mesogen
