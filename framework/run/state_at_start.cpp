#include "run/state_at_start.hpp"

#include <numeric>

#include "run/planned_fields.hpp"

namespace mesogen {

namespace {

Particles initial_particles(const Setup& setup) {
  Particles particles(setup.backend->memory());
  particles.dimension = setup.scene.dimension;
  particles.id.resize_for_overwrite(static_cast<std::size_t>(setup.arrangement.count));
  const auto id = particles.id.host(exec::Access::write);
  std::iota(id.begin(), id.end(), 0);
  for (int d = 0; d < particles.dimension; ++d) {
    particles.position[d].assign(setup.arrangement.position[d]);
    particles.images[d].resize(id.size());
  }
  return particles;
}

void set_initial_fields(const Setup& setup, State& state) {
  for (const auto& member : setup.initial) {
    InitialState initial = initial_state(member, setup);
    for (const FieldDeclaration& declared : member.plan.fields()) {
      Field* const field = state.fields.find(declared.name);
      if (field == nullptr) continue;
      for (int c = 0; c < field->components(); ++c) {
        const auto values = initial.component(declared.name, c);
        for (Index i = 0; i < state.particles.count(); ++i) field->set(c, i, values[static_cast<std::size_t>(i)]);
      }
      ++field->version;
    }
  }
}

}  // namespace

std::unique_ptr<State> state_at_start(const Setup& setup) {
  auto state =
      std::make_unique<State>(setup.scene, setup.smoothing, *setup.boundary, initial_particles(setup), *setup.backend);
  state->units = setup.source.units;
  for (const PlannedField& field : planned_fields(setup))
    state->add_field(field.name, field.components, field.integrated).kind = field.kind;
  set_initial_fields(setup, *state);
  return state;
}

}  // namespace mesogen
