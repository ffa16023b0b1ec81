#include "case/declared_sections.hpp"

#include <algorithm>

namespace mesogen {

namespace {

std::vector<SectionForm> one_form(const ParameterList& list) {
  return {{"", std::nullopt, false, declared_keys(list)}};
}

const DeclaredKey& find(const std::vector<DeclaredKey>& keys, const std::string& name) {
  return *std::find_if(keys.begin(), keys.end(), [&](const auto& key) { return key.parameter.name == name; });
}

/// In each form the key that chooses has the default that it has when nothing was chosen.
std::vector<SectionForm> with_default(std::vector<SectionForm> forms, const std::optional<Value>& standard) {
  for (auto& form : forms)
    for (auto& key : form.keys)
      if (key.parameter.name == form.key) key.standard = standard;
  return forms;
}

/// A form for each word that the text under `key` may be.
template <class Target>
std::vector<SectionForm> by_choice(const std::string& key, std::string Target::*choice,
                                   ParameterList (*list)(Target&)) {
  Target any;
  const auto keys = declared_keys(list(any));
  const DeclaredKey& chooser = find(keys, key);
  std::vector<SectionForm> forms;
  for (const auto& word : chooser.parameter.choice_list) {
    Target one;
    one.*choice = word;
    forms.push_back({key, word, !chooser.parameter.is_required && word == any.*choice, declared_keys(list(one))});
  }
  return with_default(std::move(forms), chooser.standard);
}

std::vector<SectionForm> time_forms() {
  Case::Time automatic;
  Case::Time fixed;
  fixed.step = 1.0;
  const auto keys = declared_keys(case_keys::time(automatic));
  const DeclaredKey& step = find(keys, "step");
  return with_default(
      {{"step", step.parameter.word, true, keys}, {"step", std::nullopt, false, declared_keys(case_keys::time(fixed))}},
      step.standard);
}

/// The name of a plugin, then the framework's other keys of that section.
std::vector<SectionForm> plugin_form(const std::vector<DeclaredKey>& others = {}) {
  std::string type;
  auto forms = one_form(case_keys::plugin(type));
  auto& keys = forms.front().keys;
  keys.insert(keys.end(), others.begin(), others.end());
  return forms;
}

std::vector<SectionForm> forms_of(const std::string& section) {
  Case any;
  std::string word = "single";
  ObserverTiming timing;
  std::int64_t every = 0;
  if (section.empty()) return one_form(case_keys::title(any.title));
  if (section == "units") return one_form(case_keys::units(any.units));
  if (section == "domain") return one_form(case_keys::domain(any.domain));
  if (section == "particles") return by_choice("arrangement", &Case::Particles::arrangement, case_keys::particles);
  if (section == "kernel")
    return plugin_form(declared_keys(case_keys::kernel(any.smoothing_length_ratio, any.laplacian)));
  if (section == "director") return by_choice("type", &Case::Director::type, case_keys::director);
  if (section == "velocity") return by_choice("type", &Case::Velocity::type, case_keys::velocity);
  if (section == "colour") return one_form(case_keys::colour(any.colour));
  if (section == "time") return time_forms();
  if (section == "output") return one_form(case_keys::output(any.output));
  if (section == "observers") return plugin_form(declared_keys(case_keys::timing(timing, every)));
  if (section == "run") return one_form(case_keys::run(any.run, word));
  return plugin_form();
}

}  // namespace

std::vector<DeclaredSection> declared_sections() {
  std::vector<DeclaredSection> all;
  for (const auto& section : case_keys::sections()) all.push_back({section, forms_of(section.name)});
  return all;
}

}  // namespace mesogen
