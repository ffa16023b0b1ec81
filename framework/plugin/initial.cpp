#include "mesogen/plugin/initial.hpp"

#include <fmt/format.h>

#include "mesogen/diagnostics/error.hpp"

namespace mesogen {

FieldDeclaration& InitialPlan::sets(std::string_view field, Rank rank) {
  FieldDeclaration& declaration = fields_.emplace_back();
  declaration.name = field;
  declaration.rank = rank;
  return declaration;
}

FieldDeclaration& InitialPlan::sets_velocity(std::string_view field) {
  velocity_ = field;
  return sets(field, Rank::vector);
}

InitialState::InitialState(const Scene& scene, const InitialPlan& plan, const Positions& position)
    : scene_(scene), position_(position) {
  for (const FieldDeclaration& field : plan.fields())
    values_[field.name].assign(static_cast<std::size_t>(component_count(field.rank, scene.dimension)),
                               std::vector<double>(position[0].size(), 0.0));
}

std::span<const double> InitialState::position(int axis) const { return position_.at(static_cast<std::size_t>(axis)); }

std::span<double> InitialState::component(std::string_view field, int component) {
  const auto found = values_.find(field);
  if (found == values_.end())
    throw Error(ExitCode::plugin_refused, fmt::format("sets the field '{}', which its plan() does not name", field));
  auto& components = found->second;
  if (component < 0 || component >= static_cast<int>(components.size()))
    throw Error(ExitCode::plugin_refused, fmt::format("sets component {} of '{}', which has the components 0 to {}",
                                                      component, field, components.size() - 1));
  return components[static_cast<std::size_t>(component)];
}

Initial::~Initial() = default;

void Initial::parameters(ParameterList&) {}

void Initial::publish(Scene&) {}

}  // namespace mesogen
