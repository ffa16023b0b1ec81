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
};

ExitCode write(const Options& options, const std::string& text) {
  if (options.output.empty()) {
    fmt::print("{}", text);
  } else {
    output::write_file(options.output, text);
  }
  return ExitCode::done;
}

ExitCode schema(const Options& options) {
  return write(options, document(case_schema(all_plugin_facts(load_plugins(options.folders)))));
}

ExitCode reference(const Options& options) {
  return write(options, reference_text(all_plugin_facts(load_plugins(options.folders))));
}

void add(CLI::App& command, Action& action, const std::string& name, const std::string& description,
         ExitCode (*verb)(const Options&)) {
  const auto options = std::make_shared<Options>();
  auto* const added = command.add_subcommand(name, description);
  added->add_option("-o,--output", options->output, "File to write (default: print)")->type_name("FILE");
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
