// The verbs that write down what a case may hold: for editors, and for people.

#include <fmt/format.h>

#include <memory>

#include "case_schema.hpp"
#include "options.hpp"
#include "output/write_file.hpp"
#include "reference_text.hpp"
#include "verbs.hpp"

namespace mesogen::app {

namespace {

struct Options {
  PluginFolders folders;
  std::string output;
  bool overwrite = false;
};

ExitCode write(const Options& options, std::string (*text)(const std::vector<PluginFacts>&)) {
  if (!options.output.empty()) output::require_writable(options.output, options.overwrite);
  const std::string all = text(all_plugin_facts(load_plugins(options.folders)));
  if (options.output.empty()) {
    fmt::print("{}", all);
  } else {
    output::write_file(options.output, all, output::Owner::user);
  }
  return ExitCode::done;
}

ExitCode schema(const Options& options) {
  return write(options, [](const std::vector<PluginFacts>& plugins) { return document(case_schema(plugins)); });
}

ExitCode reference(const Options& options) { return write(options, reference_text); }

void add(CLI::App& command, Action& action, const std::string& name, const std::string& description,
         ExitCode (*verb)(const Options&)) {
  const auto options = std::make_shared<Options>();
  auto* const added = command.add_subcommand(name, description);
  added->add_option("-o,--output", options->output, "File to write (default: print)")->type_name("FILE");
  added->add_flag("--overwrite", options->overwrite, "Replace the file if it is there");
  add_plugin_path(*added, options->folders);
  added->callback([&action, options, verb] { action = [options, verb] { return verb(*options); }; });
}

}  // namespace

void add_schema(CLI::App& command, Action& action) {
  add(command, action, "schema", "JSON Schema of a case, for editors", schema);
}

void add_reference(CLI::App& command, Action& action) {
  add(command, action, "reference", "All keys of a case and all plugins, as a page of Markdown", reference);
}

}  // namespace mesogen::app
