#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "command_line/parse.hpp"
#include "mesogen/testing/contract.hpp"
#include "options.hpp"
#include "plugin/instruction_set.hpp"
#include "verbs.hpp"

namespace mesogen::app {

namespace {

namespace fs = std::filesystem;

struct Options {
  std::string plugin;
  std::vector<std::string> values;
  std::vector<std::string> constants;
  PluginFolders folders;
  int seconds = 200;
};

/// KEY=VALUE
std::pair<std::string, std::string> pair_of(const std::string& option, const std::string& text) {
  const auto at = text.find('=');
  if (at == std::string::npos || at == 0)
    throw Error(ExitCode::bad_case, fmt::format("{} {}: must be KEY=VALUE", option, text));
  return {text.substr(0, at), text.substr(at + 1)};
}

testing::ContractSettings settings_of(const Options& options) {
  testing::ContractSettings settings;
  for (const auto& text : options.values) {
    const auto [key, value] = pair_of("--set", text);
    settings.values.insert_or_assign(key, value);
  }
  for (const auto& text : options.constants) {
    const auto [name, value] = pair_of("--constant", text);
    const auto number = app::number(value);
    if (!number) throw Error(ExitCode::bad_case, fmt::format("--constant {}: {} is no number", text, value));
    settings.constants.insert_or_assign(name, *number);
  }
  for (const auto& folder : options.folders) settings.folders += folder + ":";
  return settings;
}

/// Is this the file, or what is loaded for it because the processor has a wider instruction set?
bool is_loaded_for(const fs::path& loaded, const fs::path& file) {
  std::error_code ignored;
  return fs::equivalent(loaded, plugin::best_variant(file, plugin::usable_instruction_sets()).file, ignored);
}

/// All plugins that are meant, by name or by file. The folder of a file is searched too.
std::vector<const LoadedPlugin*> chosen(const PluginRegistry& registry, const Options& options,
                                        const std::optional<fs::path>& file) {
  std::vector<const LoadedPlugin*> plugins;
  for (const auto& plugin : registry.all())
    if (file ? is_loaded_for(plugin.file, *file) : plugin.descriptor->name == options.plugin)
      plugins.push_back(&plugin);
  if (!plugins.empty()) return plugins;
  if (!file) throw registry.missing(options.plugin);
  for (const auto& refused : registry.refused())
    if (is_loaded_for(refused.file, *file))
      throw Error(ExitCode::plugin_refused, fmt::format("the plugin \"{}\" was refused: {}: {}", options.plugin,
                                                        refused.file.string(), refused.reason));
  throw Error(ExitCode::bad_case,
              fmt::format("{} is no plugin: Mesogen loads libraries whose names end in .so", options.plugin));
}

bool report(const LoadedPlugin& plugin, const testing::ContractSettings& settings, int seconds) {
  using Outcome = testing::ContractCheck::Outcome;
  const auto& descriptor = *plugin.descriptor;
  const auto checks =
      testing::check_contract_apart(descriptor.kind, descriptor.name, settings, static_cast<unsigned>(seconds));
  fmt::print("{} {} {}: {}\n", to_string(descriptor.kind), descriptor.name, descriptor.version, plugin.file.string());
  std::size_t broken = 0;
  for (const auto& check : checks) {
    const auto* const word =
        check.outcome == Outcome::held ? "ok    " : (check.outcome == Outcome::note ? "note  " : "FAILED");
    fmt::print("  {}  {}{}{}\n", word, check.what, check.problem.empty() ? "" : ": ", check.problem);
    if (check.outcome == Outcome::broken) ++broken;
  }
  if (broken > 0) fmt::print("{} is not fit for use: {} of its checks failed\n", descriptor.name, broken);
  return broken == 0;
}

ExitCode check(Options options) {
  std::optional<fs::path> file;
  if (options.plugin.find('/') != std::string::npos || options.plugin.ends_with(".so")) {
    file = fs::absolute(options.plugin);
    if (!fs::is_regular_file(*file))
      throw Error(ExitCode::bad_case, fmt::format("there is no plugin file {}", options.plugin));
    // First, so that the file goes before a twin that was installed.
    options.folders.insert(options.folders.begin(), file->parent_path().string());
  }
  const auto registry = load_plugins(options.folders, true, file ? Twins::first_folder : Twins::refused);
  const auto settings = settings_of(options);
  bool held = true;
  for (const auto* plugin : chosen(registry, options, file)) held = report(*plugin, settings, options.seconds) && held;
  return held ? ExitCode::done : ExitCode::run_failed;
}

}  // namespace

void add_plugin_check(Verb& plugin) {
  const auto options = std::make_shared<Options>();
  Verb& verb = plugin.verb("check", "Check that a plugin does what every plugin of its kind must do",
                           [options] { return check(*options); });
  verb.argument("PLUGIN", &options->plugin, "Name of a plugin, or its file (.so)");
  verb.option("--set", "KEY=VALUE", &options->values,
              "A parameter of the plugin; may be repeated (default: the plugin's own, or a value in its range)");
  verb.option("--constant", "NAME=NUMBER", &options->constants,
              "A number that another plugin of a case would publish; may be repeated");
  verb.option("--time-limit", "SECONDS", &options->seconds,
              "Wall time that one check may take before it fails, in s, 1 to 86400 (default: 200)",
              {.lowest = 1, .highest = 86400});
  add_plugin_path(verb, options->folders);
}

}  // namespace mesogen::app
