#include "case/case.hpp"

#include <algorithm>

#include "case/case_reader.hpp"
#include "case/checks.hpp"
#include "case/resolved.hpp"
#include "case/toml_reader.hpp"
#include "mesogen/diagnostics/error.hpp"

namespace mesogen {

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
  const auto before = problems.size();
  Case result;
  result.file = name;
  auto tree = parse_toml(text, name, problems);
  if (tree == nullptr) return result;
  for (const auto& change : overrides) apply_override(*tree, change, problems);
  result.tree = std::move(tree);
  read_sections(result, problems);
  check_case(result, problems);
  if (problems.size() == before) result.resolved_text = ResolvedCase(result).text();
  return result;
}

}  // namespace mesogen
