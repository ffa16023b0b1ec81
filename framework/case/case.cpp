#include "case/case.hpp"

#include <algorithm>

#include "case/case_reader.hpp"
#include "case/checks.hpp"
#include "case/resolved.hpp"
#include "case/toml_reader.hpp"
#include "case/value.hpp"
#include "mesogen/diagnostics/error.hpp"
#include "mesogen/fields/dimensions.hpp"

namespace mesogen {

namespace {

/// Fills a case from its file and tree.
void read_tree(Case& target, std::unique_ptr<Value> tree, Problems& problems) {
  const auto before = problems.size();
  target.tree = std::move(tree);
  read_sections(target, problems);
  check_case(target, problems);
  if (problems.size() == before) target.resolved_text = ResolvedCase(target).text();
}

/// Puts the observers of a file in the place of those of a case.
void exchange_observers(Value& root, const std::string& file, Problems& problems) {
  const auto before = problems.size();
  const std::string text = read_text_file(file, problems);
  if (problems.size() != before) return;
  const auto other = parse_toml(text, file, problems);
  if (other == nullptr) return;
  const Value* const observers = other->find("observers");
  if (observers == nullptr || observers->as<Value::Table>() == nullptr || observers->as<Value::Table>()->empty()) {
    problems.add(
        {file, 1, 1}, "observers",
        "must hold at least one table with a type, such as [observers.flow]; nothing else of this file is used");
    return;
  }
  // Not set_path: keys keep their places.
  auto* const table = root.as<Value::Table>();
  std::erase_if(*table, [](const Entry& entry) { return entry.key == "observers"; });
  table->push_back({"observers", observers->place, *observers});
}

}  // namespace

int Case::dimension() const {
  return domain.size.empty() ? built_dimensions.list().front() : static_cast<int>(domain.size.size());
}

SourcePlace Case::place(std::string_view dotted_key) const {
  const SourcePlace start{file, 1, 1};
  return tree == nullptr ? start : tree->place_of_path(dotted_key);
}

void PluginChoice::read(const ParameterList& list, Problems& problems) const {
  for (const auto& parameter : list.all()) {
    const auto key = parameter.name.substr(0, parameter.name.find('.'));
    if (std::find(framework_keys.begin(), framework_keys.end(), key) != framework_keys.end())
      throw Error(ExitCode::plugin_refused, "plugin \"" + type + "\" declares the parameter \"" + parameter.name +
                                                "\", a key that the framework reads itself: give it another name");
  }
  section.read(list, problems, framework_keys);
}

Case read_case(const std::string& path, const std::vector<std::string>& overrides, Problems& problems) {
  const auto before = problems.size();
  const std::string text = read_text_file(path, problems);
  if (problems.size() == before) return read_case_text(text, path, overrides, problems);
  Case unread;
  unread.file = path;
  return unread;
}

Case read_case_text(std::string_view text, const std::string& name, const std::vector<std::string>& overrides,
                    Problems& problems) {
  Case result;
  result.file = name;
  auto tree = parse_toml(text, name, problems);
  if (tree == nullptr) return result;
  for (const auto& change : overrides) apply_override(*tree, change, problems);
  read_tree(result, std::move(tree), problems);
  return result;
}

Case read_case_with_observers(std::string_view text, const std::string& name, const std::string& observers,
                              const std::vector<std::string>& overrides, Problems& problems) {
  Case result;
  result.file = name;
  auto tree = parse_toml(text, name, problems);
  if (tree == nullptr) return result;
  if (!observers.empty()) exchange_observers(*tree, observers, problems);
  for (const auto& change : overrides) {
    if (change.starts_with("observers.")) {
      apply_override(*tree, change, problems);
    } else {
      problems.add({"--set", 0, 0}, change.substr(0, change.find('=')),
                   "cannot be changed: only keys of observers can, such as observers.flow.type=flow_statistics");
    }
  }
  read_tree(result, std::move(tree), problems);
  return result;
}

}  // namespace mesogen
