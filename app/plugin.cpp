#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "case/nearest.hpp"
#include "options.hpp"
#include "plugin_text.hpp"
#include "verbs.hpp"

namespace mesogen::app {

namespace {

constexpr std::array kinds{PluginKind::kernel, PluginKind::boundary, PluginKind::physics, PluginKind::observer};

ExitCode list(const PluginFolders& folders) {
  const auto registry = load_plugins(folders);
  for (const auto kind : kinds) {
    fmt::print("{}\n", to_string(kind));
    for (const auto& plugin : registry.all())
      if (plugin.descriptor->kind == kind)
        fmt::print("  {:<20} {:<8} {}\n", plugin.descriptor->name, plugin.descriptor->version,
                   plugin.descriptor->summary);
  }
  return ExitCode::done;
}

ExitCode info(const PluginFolders& folders, const std::string& name) {
  const auto registry = load_plugins(folders);
  bool found = false;
  std::vector<std::string> names;
  for (const auto& plugin : registry.all()) {
    names.emplace_back(plugin.descriptor->name);
    if (names.back() != name) continue;
    fmt::print("{}{}", found ? "\n" : "", info_text(registry, plugin));
    found = true;
  }
  if (found) return ExitCode::done;
  for (const auto& refused : registry.refused())
    if (refused.file.stem() == name)
      throw Error(ExitCode::plugin_refused,
                  fmt::format("the plugin \"{}\" was refused: {}: {}", name, refused.file.string(), refused.reason));
  throw Error(ExitCode::bad_case, fmt::format("no plugin is called \"{}\" (there are: {}){}", name,
                                              fmt::join(names, ", "), did_you_mean(name, names)));
}

}  // namespace

void add_plugin(CLI::App& command, Action& action) {
  auto* const plugin = command.add_subcommand("plugin", "Tell about plugins");
  plugin->require_subcommand(0, 1);

  const auto folders = std::make_shared<PluginFolders>();
  auto* const list_verb = plugin->add_subcommand("list", "All plugins, by kind");
  add_plugin_path(*list_verb, *folders);
  list_verb->callback([&action, folders] { action = [folders] { return list(*folders); }; });

  const auto name = std::make_shared<std::string>();
  auto* const info_verb = plugin->add_subcommand("info", "Parameters, fields and passes of one plugin, and its file");
  info_verb->add_option("name", *name, "Name of a plugin")->type_name("NAME")->required();
  add_plugin_path(*info_verb, *folders);
  info_verb->callback([&action, folders, name] { action = [folders, name] { return info(*folders, *name); }; });
}

}  // namespace mesogen::app
