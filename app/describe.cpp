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

ExitCode schema(const Options& options) { return write(options, case_schema); }

ExitCode reference(const Options& options) { return write(options, reference_text); }

void add(Verb& command, const std::string& word, const std::string& summary, ExitCode (*task)(const Options&)) {
  const auto options = std::make_shared<Options>();
  Verb& verb = command.verb(word, summary, [options, task] { return task(*options); });
  verb.option("--output", "FILE", &options->output, "File to write (default: print it)", {.letter = 'o'});
  verb.flag("--overwrite", &options->overwrite, "Replace the file if it exists");
  add_plugin_path(verb, options->folders);
}

}  // namespace

void add_schema(Verb& command) { add(command, "schema", "Write the JSON Schema of a case, for editors", schema); }

void add_reference(Verb& command) {
  add(command, "reference", "Write a page of Markdown about all keys of a case and all plugins", reference);
}

}  // namespace mesogen::app
