#include "contract_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <set>

#include "case/case.hpp"
#include "case/toml_text.hpp"
#include "mesogen/testing/plugin_harness.hpp"
#include "plugin/sample_scene.hpp"
#include "scene_text.hpp"

namespace mesogen::testing {

namespace {

/// A value of a required parameter that is in its range, as TOML; see ContractSettings.
std::string value_in_range(const Parameter& parameter) {
  double number = 1.0;
  const bool low = std::isfinite(parameter.lowest);
  const bool high = std::isfinite(parameter.highest);
  if (low && high) number = 0.5 * (parameter.lowest + parameter.highest);
  if (low && !high) number = parameter.lowest + 1.0;
  if (high && !low) number = parameter.highest - 1.0;
  const std::string floating = fmt::format("{:.17g}", number);
  const std::string text = parameter.choice_list.empty() ? "\"text\"" : '"' + parameter.choice_list.front() + '"';
  const std::size_t size =
      parameter.size_list.empty() ? 1 : *std::min_element(parameter.size_list.begin(), parameter.size_list.end());
  std::string list;
  for (std::size_t n = 0; n < size; ++n) list += (n > 0 ? ", " : "") + floating;
  const std::string type = parameter.type_text();
  if (type == "integer") return fmt::format("{:.0f}", std::ceil(number));
  if (type == "true or false") return "false";
  if (type == "text") return text;
  if (type == "list of texts") return "[" + text + "]";
  if (type.starts_with("list of lists")) return "[[" + list + "]]";
  if (type.starts_with("list")) return "[" + list + "]";
  return floating.find_first_of(".e") == std::string::npos ? floating + ".0" : floating;
}

/// Where a scene chooses the plugin under test.
const PluginChoice& choice_of(PluginKind kind, const Case& scene) {
  switch (kind) {
    case PluginKind::kernel: return scene.kernel;
    case PluginKind::boundary: return scene.boundary;
    case PluginKind::shape: return scene.shapes.front();
    case PluginKind::initial: return scene.initial.front();
    case PluginKind::physics: return scene.physics.front();
    case PluginKind::observer: break;
  }
  return scene.observers.front();
}

std::string section_of(PluginKind kind, const std::string& name) {
  switch (kind) {
    case PluginKind::kernel: return "kernel.";
    case PluginKind::boundary: return "domain.boundary.";
    case PluginKind::shape: return fmt::format("solids.{}.", tested_instance);
    case PluginKind::initial: return name + ".";
    case PluginKind::physics: return fmt::format("physics.{}.", tested_instance);
    case PluginKind::observer: break;
  }
  return fmt::format("observers.{}.", tested_instance);
}

void replace_all(std::string& text, const std::string& what, std::string_view by) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
}

/// The names of all numbers that any physics plugin publishes.
std::set<std::string> published(const PluginRegistry& registry, int dimension) {
  std::set<std::string> names;
  for (const auto& [name, value] : sample_scene(registry, dimension).constants) names.insert(name);
  return names;
}

}  // namespace

std::string keys_of(PluginKind kind, const std::string& name, const ParameterList& list, const PluginRegistry& registry,
                    const ContractSettings& settings) {
  std::string keys;
  for (const Parameter& parameter : list.all())
    if (parameter.is_required && parameter.condition_key.empty() && !settings.values.contains(parameter.name))
      keys += fmt::format("{} = {}\n", parameter.name, value_in_range(parameter));
  if (settings.values.empty()) return keys;

  // The case reader judges the values, as overrides of a case: so a word needs no quotes, and --set is named.
  const std::string section = section_of(kind, name);
  std::vector<std::string> overrides;
  for (const auto& [key, value] : settings.values) overrides.push_back(section + key + "=" + value);
  Problems problems;
  const Case scene = read_case_text(scene_text(kind, name, keys, {}, registry), "the scene", overrides, problems);
  const PluginChoice& choice = choice_of(kind, scene);
  for (const std::string& key : choice.framework_keys)
    if (settings.values.contains(key))
      problems.add({"--set", 0, 0}, key, "a key of the framework: only parameters of the plugin can be set here");
  if (problems.empty()) choice.section.read(list, problems, choice.framework_keys);
  if (!problems.empty()) {
    std::string text = problems.text();
    replace_all(text, section, "");
    throw Error(ExitCode::bad_case, text);
  }
  for (const auto& [key, value] : settings.values)
    keys += fmt::format("{} = {}\n", key, inline_text(*scene.tree->find_path(section + key)));
  return keys;
}

void require_constants(PluginKind kind, const std::string& name, const std::string& keys,
                       const PluginRegistry& registry, const ContractSettings& settings) {
  const auto can_be_made = [&](const std::map<std::string, double>& constants) {
    try {
      TestScene scene;
      scene.constants = constants;
      (void)PluginHarness(kind, name, keys, scene, settings.folders).scene();
      return true;
    } catch (const std::exception&) {
      return false;
    }
  };
  if (can_be_made(settings.constants)) return;
  const std::set<std::string> constants = published(registry, registry.smallest_dimension(kind, name));
  auto all = settings.constants;
  for (const std::string& constant : constants) all.emplace(constant, 1.0);
  // Another fault, which a check will name.
  if (!can_be_made(all)) return;
  std::string missing;
  for (const std::string& constant : constants) {
    if (settings.constants.contains(constant)) continue;
    auto without = all;
    without.erase(constant);
    if (can_be_made(without)) {
      all = std::move(without);
    } else {
      missing += fmt::format(" --constant {}=VALUE", constant);
    }
  }
  throw Error(ExitCode::bad_case,
              fmt::format("{} needs numbers that another plugin of a case would publish: add{}", name, missing));
}

}  // namespace mesogen::testing
