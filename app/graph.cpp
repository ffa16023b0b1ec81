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

void add_graph(Verb& command) {
  const auto options = std::make_shared<Options>();
  Verb& verb = command.verb("graph", "Print the passes of a step in their order, and those left out",
                            [options] { return graph(*options); });
  add_case(verb, options->source);
  verb.flag("--dot", &options->graphviz, "Print Graphviz: mesogen graph CASE --dot | dot -Tsvg -o step.svg");
}

}  // namespace mesogen::app
