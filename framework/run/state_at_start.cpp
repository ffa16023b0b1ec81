#include "run/state_at_start.hpp"

#include <numeric>
#include <span>

#include "run/planned_fields.hpp"

namespace mesogen {

namespace {

// Each rank takes as many; the first sorting brings them to where they belong.
Particles initial_particles(const Setup& setup) {
  Particles particles(setup.backend->memory());
  particles.dimension = setup.scene.dimension;
  const std::int64_t count = setup.arrangement.count;
  const std::int64_t first = count * setup.ranks->rank() / setup.ranks->count();
  const std::int64_t end = count * (setup.ranks->rank() + 1) / setup.ranks->count();
  particles.id.resize_for_overwrite(static_cast<std::size_t>(end - first));
  const auto id = particles.id.host(exec::Access::write);
  std::iota(id.begin(), id.end(), first);
  for (int d = 0; d < particles.dimension; ++d) {
    const std::span all(setup.arrangement.position[d]);
    particles.position[d].assign(all.subspan(static_cast<std::size_t>(first), id.size()));
    particles.images[d].resize(id.size());
  }
  return particles;
}

void set_initial_fields(const Setup& setup, State& state) {
  const auto id = state.particles.id.host();
  for (const auto& member : setup.initial) {
    InitialState initial = initial_state(member, setup);
    for (const FieldDeclaration& declared : member.plan.fields()) {
      Field* const field = state.fields.find(declared.name);
      if (field == nullptr) continue;
      for (int c = 0; c < field->components(); ++c) {
        const auto values = initial.component(declared.name, c);
        for (std::size_t i = 0; i < id.size(); ++i)
          field->set(c, static_cast<Index>(i), values[static_cast<std::size_t>(id[i])]);
      }
      ++field->version;
    }
  }
}

}  // namespace

std::unique_ptr<State> state_at_start(const Setup& setup) {
  auto state = std::make_unique<State>(setup.scene, setup.smoothing, *setup.boundary, initial_particles(setup),
                                       *setup.backend, *setup.ranks);
  state->units = setup.source.units;
  for (const PlannedField& field : planned_fields(setup))
    state->add_field(field.name, field.components, field.integrated).kind = field.kind;
  set_initial_fields(setup, *state);
  return state;
}

}  // namespace mesogen
