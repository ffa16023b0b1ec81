#include "schedule/prescribed_fields.hpp"

#include <utility>

#include "mesogen/exec/dispatch.hpp"
#include "particles/field_loops.hpp"
#include "prescribed/surroundings.hpp"

namespace mesogen {

PrescribedFields::PrescribedFields(State& state, const std::vector<Prescribed>& prescribed) : state_(state) {
  exec::DeviceMemory* const memory = state.backend.memory();
  for (const Prescribed& one : prescribed) {
    Made made;
    made.prescribed = &one;
    for (const Program& program : one.components) {
      Component component{&program, exec::Array<exec::Instruction>(memory), {}};
      component.code.assign(program.code);
      for (const Film& film : program.films) component.films.emplace_back(memory).assign(film.pixels);
      made.components.push_back(std::move(component));
    }
    made.value = state.fields.find(one.field());
    made_by_[one.field()] = all_.size();
    if (one.has_gradient()) {
      made.gradient = state.fields.find(one.field() + "_gradient");
      made_by_[one.field() + "_gradient"] = all_.size();
    }
    all_.push_back(std::move(made));
  }
}

std::vector<std::uint64_t> PrescribedFields::versions(const Made& made) const {
  std::vector<std::uint64_t> all;
  for (const Component& component : made.components)
    for (const std::string& field : component.program->fields) all.push_back(state_.fields.at(field).version);
  return all;
}

bool PrescribedFields::stale(const Made& made) const {
  const bool later = made.time != state_.time && made.prescribed->changes_in_time();
  return later || made.positions != state_.order.version() || made.sources != versions(made);
}

void PrescribedFields::make(const std::string& field) {
  Made& made = all_[made_by_.at(field)];
  if (!stale(made)) return;
  const Span span(counter_, state_.clock.trace);
  for (std::size_t n = 0; n < made.components.size(); ++n)
    dispatch(state_.scene.precision, [&]<class Real>() { run<Real>(made, n); });
  state_.clock.end_of_work();
  for (Field* const written : {made.value, made.gradient})
    if (written != nullptr) ++written->version;
  made.positions = state_.order.version();
  made.time = state_.time;
  made.sources = versions(made);
}

template <class Real>
void PrescribedFields::run(Made& made, std::size_t n) {
  constexpr auto device = exec::Side::device;
  // Ghosts keep what they have.
  constexpr auto read_write = exec::Access::read_write;
  const Component& component = made.components[n];
  const Program& program = *component.program;
  exec::EvaluateArguments<Real> arguments{};
  arguments.program = program.view();
  arguments.program.code = component.code.device();
  arguments.around = surroundings<Real>(state_.scene, state_.time);
  for (int d = 0; d < state_.scene.dimension; ++d)
    arguments.around.position[d] = state_.particles.position[static_cast<std::size_t>(d)].device();
  for (std::size_t f = 0; f < program.fields.size(); ++f)
    arguments.around.field[f] = std::as_const(state_.fields.at(program.fields[f])).view<Real>(device);
  for (std::size_t f = 0; f < program.films.size(); ++f)
    arguments.around.film[f] = film_view(program.films[f], component.films[f].device(), state_.time);
  if (made.value != nullptr)
    arguments.result = made.value->view<Real>(device, read_write).component(static_cast<int>(n));
  if (made.gradient != nullptr)
    for (int d = 0; d < state_.scene.dimension; ++d) {
      arguments.varies_along[d] = program.varies_along(d);
      arguments.gradient[d] = made.gradient->view<Real>(device, read_write).component(d);
    }
  arguments.reach = state_.scene.spacing;
  state_.backend.fields<Real>().evaluate(arguments, state_.particles.count());
}

}  // namespace mesogen
