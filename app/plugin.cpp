#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

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
    fmt::print("{}", list_json(registry));
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
  for (const auto& plugin : registry.all())
    if (plugin.descriptor->name == name) found.push_back(plugin_facts(registry, plugin));
  if (found.empty()) throw registry.missing(name);
  return found;
}

ExitCode info(const Options& options) {
  const auto found = facts_of(load_plugins(options.folders), options.name);
  if (options.json) {
    fmt::print("{}", info_json(found));
  } else {
    for (std::size_t n = 0; n < found.size(); ++n) fmt::print("{}{}", n > 0 ? "\n" : "", info_text(found[n]));
  }
  return ExitCode::done;
}

}  // namespace

void add_plugin(Verb& command) {
  Verb& plugin = command.verb("plugin", "Describe plugins, write and check new ones");
  const auto options = std::make_shared<Options>();
  Verb& list_verb =
      plugin.verb("list", "List all plugins by kind, with their files", [options] { return list(*options); });
  Verb& info_verb = plugin.verb("info", "Print parameters, fields, passes and quantities of a plugin, and its file",
                                [options] { return info(*options); });
  info_verb.argument("NAME", &options->name, "Name of a plugin, for example wcsph");
  for (Verb* const verb : {&list_verb, &info_verb}) {
    verb->flag("--json", &options->json, "Print JSON, for programs");
    add_plugin_path(*verb, options->folders);
  }
  add_plugin_new(plugin);
  add_plugin_check(plugin);
}

}  // namespace mesogen::app
