#include <fmt/format.h>

#include <memory>

#include "options.hpp"
#include "verbs.hpp"

namespace mesogen::app {

namespace {

struct Options {
  CaseOptions source;
  bool graphviz = false;
};

ExitCode graph(const Options& options) {
  const auto setup = set_up(options.source, load_plugins(options.source.plugin_folders));
  const auto text = options.graphviz ? setup->graph->graphviz() : setup->graph->text();
  fmt::print("{}{}", text, text.ends_with('\n') ? "" : "\n");
  return ExitCode::done;
}

}  // namespace

void add_graph(CLI::App& command, Action& action) {
  const auto options = std::make_shared<Options>();
  auto* const verb = command.add_subcommand("graph", "The work of a step in its order, and what is left out");
  add_case(*verb, options->source);
  verb->add_flag("--dot", options->graphviz, "For Graphviz: mesogen graph CASE --dot | dot -Tsvg -o step.svg");
  verb->callback([&action, options] { action = [options] { return graph(*options); }; });
}

}  // namespace mesogen::app
