#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "case/nearest.hpp"
#include "options.hpp"
#include "plugin_json.hpp"
#include "plugin_text.hpp"
#include "verbs.hpp"

namespace mesogen::app {

namespace {

namespace fs = std::filesystem;

struct Options {
  PluginFolders folders;
  std::string name;
  bool json = false;
};

/// Relative to the current folder if it lies below, which is easier to read.
std::string readable(const fs::path& file) {
  std::error_code ignored;
  const auto here = fs::current_path(ignored);
  const auto relative = file.lexically_relative(here);
  return ignored || relative.empty() || *relative.begin() == ".." ? file.string() : relative.string();
}

ExitCode list(const Options& options) {
  const auto registry = load_plugins(options.folders, options.json);
  if (options.json) {
    Json plugins = Json::array();
    for (const auto& [descriptor, file, instruction_set] : registry.all())
      plugins.push_back({{"kind", to_string(descriptor->kind)},
                         {"name", descriptor->name},
                         {"version", descriptor->version},
                         {"summary", descriptor->summary},
                         {"file", file.string()},
                         {"instruction_set", instruction_set}});
    Json refused = Json::array();
    for (const auto& [file, reason] : registry.refused())
      refused.push_back({{"file", file.string()}, {"reason", reason}});
    fmt::print("{}", document({{"plugins", plugins}, {"refused", refused}}));
    return ExitCode::done;
  }
  for (const auto kind : plugin_kinds) {
    fmt::print("{}\n", to_string(kind));
    for (const auto& [descriptor, file, instruction_set] : registry.all())
      if (descriptor->kind == kind)
        fmt::print("  {:<20} {:<8} {}\n  {:<20} {:<8} {}\n", descriptor->name, descriptor->version, descriptor->summary,
                   "", "", readable(file));
  }
  const auto physics = registry.names(PluginKind::physics);
  if (std::ranges::none_of(physics, [&](const std::string& name) { return registry.has_cuda(name); }))
    fmt::print("no plugin has code for NVIDIA GPUs: `MESOGEN_CUDA=on scripts/setup` builds it, where nvcc is\n");
  return ExitCode::done;
}

/// There may be several of one name, each of another kind.
std::vector<PluginFacts> facts_of(const PluginRegistry& registry, const std::string& name) {
  std::vector<PluginFacts> found;
  std::vector<std::string> names;
  for (const auto& plugin : registry.all()) {
    names.emplace_back(plugin.descriptor->name);
    if (names.back() == name) found.push_back(plugin_facts(registry, plugin));
  }
  if (!found.empty()) return found;
  for (const auto& refused : registry.refused())
    if (refused.file.stem() == name)
      throw Error(ExitCode::plugin_refused,
                  fmt::format("the plugin \"{}\" was refused: {}: {}", name, refused.file.string(), refused.reason));
  throw Error(ExitCode::bad_case, fmt::format("no plugin is called \"{}\" (there are: {}){}", name,
                                              fmt::join(names, ", "), did_you_mean(name, names)));
}

ExitCode info(const Options& options) {
  const auto found = facts_of(load_plugins(options.folders), options.name);
  if (options.json) {
    Json plugins = Json::array();
    for (const auto& facts : found) plugins.push_back(info_json(facts));
    fmt::print("{}", document({{"plugins", plugins}}));
  } else {
    for (std::size_t n = 0; n < found.size(); ++n) fmt::print("{}{}", n > 0 ? "\n" : "", info_text(found[n]));
  }
  return ExitCode::done;
}

}  // namespace

void add_plugin(CLI::App& command, Action& action) {
  auto* const plugin = command.add_subcommand("plugin", "Tell about plugins, write and check new ones");
  plugin->require_subcommand(0, 1);

  const auto options = std::make_shared<Options>();
  auto* const list_verb = plugin->add_subcommand("list", "All plugins, by kind, with their files");
  auto* const info_verb =
      plugin->add_subcommand("info", "Parameters, fields, passes, quantities of one plugin, and its file");
  info_verb->add_option("name", options->name, "Name of a plugin")->type_name("NAME")->required();
  for (auto* const verb : {list_verb, info_verb}) {
    verb->add_flag("--json", options->json, "For programs");
    add_plugin_path(*verb, options->folders);
  }
  list_verb->callback([&action, options] { action = [options] { return list(*options); }; });
  info_verb->callback([&action, options] { action = [options] { return info(*options); }; });
  add_plugin_new(*plugin, action);
  add_plugin_check(*plugin, action);
}

}  // namespace mesogen::app
