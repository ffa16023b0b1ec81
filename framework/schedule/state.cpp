#include "schedule/state.hpp"

namespace mesogen {

State::State(Scene scene_of_run, sph::SmoothingKernel kernel_of_run, const Boundary& boundary_of_run, Particles all,
             const Backend& backend_of_run, const Ranks& ranks_of_run)
    : scene(std::move(scene_of_run)),
      kernel(std::move(kernel_of_run)),
      boundary(boundary_of_run),
      backend(backend_of_run),
      ranks(ranks_of_run),
      clock{backend},
      particles(std::move(all)),
      neighbourhood(scene, boundary, backend, ranks),
      order(particles, neighbourhood, fields, clock, ranks),
      boundary_values(scene, boundary, neighbourhood, kernel, clock, ranks),
      chosen(backend.memory()) {}

void State::wait() const {
  backend.wait();
  if (ranks.several()) ranks.largest(backend.all_found());
}

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

}  // namespace mesogen
