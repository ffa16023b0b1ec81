#include "forecast/advice.hpp"

#include "forecast/advice_rules.hpp"
#include "plugin/plugin_call.hpp"

namespace mesogen {

namespace rules {

std::string key_of(const Setup& setup, const std::string& parameter) {
  for (const auto& member : setup.physics) {
    ParameterList list;
    member.plugin->parameters(list);
    for (const Parameter& declared : list.all())
      if (declared.name == parameter) return member.instance + "." + parameter;
  }
  return {};
}

}  // namespace rules

std::vector<Advice> advice(const AdviceInput& input) {
  constexpr rules::Rule* all[] = {rules::no_inertia,         rules::few_neighbours, rules::core_under_resolved,
                                  rules::core_over_resolved, rules::sound_too_slow, rules::sound_too_fast,
                                  rules::wall_jump,          rules::short_step,     rules::double_precision,
                                  rules::nothing_grows,      rules::no_order,       rules::large_output};
  std::vector<Advice> given;
  for (rules::Rule* const rule : all)
    if (auto one = rule(input)) given.push_back(std::move(*one));
  for (const auto& member : input.setup.physics) {
    std::vector<Suggestion> suggestions;
    call_plugin(member.type, "suggest()",
                [&] { member.plugin->suggest(input.setup.scene, input.setup.limits, suggestions); });
    for (Suggestion& one : suggestions) {
      for (std::string& setting : one.settings) setting = member.instance + "." + setting;
      given.push_back({one.name, one.finding, one.settings, one.gain});
    }
  }
  return given;
}

}  // namespace mesogen
