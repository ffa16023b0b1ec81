#include "forecast/advice.hpp"

#include <cmath>
#include <set>
#include <string>

#include "case/arrangement.hpp"
#include "forecast/advice_rules.hpp"
#include "plugin/plugin_call.hpp"

namespace mesogen {

namespace {

/// The largest spacing, not above this one, for which whole columns and rows fit the box.
double fitting_spacing(const Setup& setup, double at_most) {
  const double length = setup.scene.box[0];
  const double first = std::ceil(length / at_most);
  Case source = setup.source;
  const auto fits = [&](double columns) {
    source.particles.spacing = length / columns;
    return arrangement_problem(source).empty();
  };
  double columns = first;
  while (columns < 2.0 * first && !fits(columns)) ++columns;
  return length / columns;
}

}  // namespace

std::vector<Suggestion> advice(const AdviceInput& input) {
  constexpr rules::Rule* all[] = {rules::few_neighbours, rules::short_step, rules::double_precision,
                                  rules::large_output};
  std::vector<Suggestion> given;
  for (rules::Rule* const rule : all)
    if (auto one = rule(input)) given.push_back(std::move(*one));
  const Setup& setup = input.setup;
  for (const auto& member : setup.physics) {
    if (!member.passes.advice()) continue;
    const AdviceContext context{.scene = setup.scene,
                                .limits = setup.limits,
                                .binding = input.steps.cause,
                                .step_is_given = input.steps.fixed,
                                .section = member.instance,
                                .unit = [&](std::string_view si) { return setup.source.units.text(si); },
                                .fitting_spacing = [&](double at_most) { return fitting_spacing(setup, at_most); }};
    call_plugin(member.type, "advice", [&] { member.passes.advice()(context, given); });
  }
  return given;
}

std::vector<SceneNumber> scene_numbers(const Setup& setup) {
  std::vector<SceneNumber> all;
  for (const auto& member : setup.physics)
    if (member.passes.numbers())
      call_plugin(member.type, "numbers", [&] { member.passes.numbers()(setup.scene, all); });
  // Two plugins of a kind tell the same.
  std::set<std::string> told;
  std::erase_if(all, [&](const SceneNumber& number) { return !told.insert(number.name).second; });
  for (SceneNumber& number : all) number.unit = setup.source.units.text(number.unit);
  return all;
}

}  // namespace mesogen
