#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "case/nearest.hpp"
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
  unsigned seconds = 200;
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
    double number = 0.0;
    if (!CLI::detail::lexical_cast(value, number))
      throw Error(ExitCode::bad_case, fmt::format("--constant {}: {} is no number", text, value));
    settings.constants.insert_or_assign(name, number);
  }
  for (const auto& folder : options.folders) settings.folders += folder.string() + ":";
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
  std::vector<std::string> names;
  for (const auto& plugin : registry.all()) {
    names.emplace_back(plugin.descriptor->name);
    if (file ? is_loaded_for(plugin.file, *file) : names.back() == options.plugin) plugins.push_back(&plugin);
  }
  if (!plugins.empty()) return plugins;
  for (const auto& refused : registry.refused())
    if (file ? is_loaded_for(refused.file, *file) : refused.file.stem() == options.plugin)
      throw Error(ExitCode::plugin_refused, fmt::format("the plugin \"{}\" was refused: {}: {}", options.plugin,
                                                        refused.file.string(), refused.reason));
  if (file)
    throw Error(ExitCode::bad_case,
                fmt::format("{} is no plugin: Mesogen loads libraries whose names end in .so", options.plugin));
  throw Error(ExitCode::bad_case,
              fmt::format("no plugin is called \"{}\"{}; `mesogen plugin list` tells which there are", options.plugin,
                          did_you_mean(options.plugin, names)));
}

bool report(const LoadedPlugin& plugin, const testing::ContractSettings& settings, unsigned seconds) {
  using Outcome = testing::ContractCheck::Outcome;
  const auto& descriptor = *plugin.descriptor;
  const auto checks = testing::check_contract_apart(descriptor.kind, descriptor.name, settings, seconds);
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
    options.folders.insert(options.folders.begin(), file->parent_path());
  }
  const auto registry = load_plugins(options.folders, true, file ? Twins::first_folder : Twins::refused);
  const auto settings = settings_of(options);
  bool held = true;
  for (const auto* plugin : chosen(registry, options, file)) held = report(*plugin, settings, options.seconds) && held;
  return held ? ExitCode::done : ExitCode::run_failed;
}

}  // namespace

void add_plugin_check(CLI::App& plugin, Action& action) {
  const auto options = std::make_shared<Options>();
  auto* const verb =
      plugin.add_subcommand("check", "Check that a plugin holds what every plugin of its kind must hold");
  verb->add_option("plugin", options->plugin, "Name of a plugin, or its file")->type_name("NAME|FILE")->required();
  verb->add_option("--set", options->values,
                   "A parameter of the plugin; required ones that are not given are taken from their range")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  verb->add_option("--constant", options->constants, "A number that another plugin of a case would publish")
      ->type_name("NAME=NUMBER")
      ->allow_extra_args(false);
  verb->add_option("--time-limit", options->seconds,
                   "Seconds that one check may take; it fails if the plugin is not back by then (default: 200)")
      ->type_name("SECONDS")
      ->check(CLI::Range(1, 86400));
  add_plugin_path(*verb, options->folders);
  verb->callback([&action, options] { action = [options] { return check(*options); }; });
}

}  // namespace mesogen::app
