#include <fmt/format.h>

#include <memory>

#include "json.hpp"
#include "options.hpp"
#include "plugin_facts.hpp"
#include "verbs.hpp"

namespace mesogen::app {

namespace {

struct Options {
  CaseOptions source;
  bool json = false;
};

void print_text(const Setup& setup) {
  const auto line = [](std::string_view name, std::string_view form, std::string_view unit, std::string_view doc) {
    std::string text = fmt::format("{:<32} {:<28} {:<10} {}", name, form, unit, doc);
    text.erase(text.find_last_not_of(' ') + 1);
    fmt::print("{}\n", text);
  };
  line("QUANTITY", "A SAMPLE IS", "UNIT", "");
  for (const auto& observer : setup.observers)
    for (const Quantity& quantity : observer.plan.quantities())
      line(observer.instance + "." + quantity.name, form_text(quantity), quantity.unit_text, quantity.doc_text);
}

void print_json(const Setup& setup) {
  Json all = Json::object();
  for (const auto& observer : setup.observers) {
    Json& quantities = all[observer.instance] = Json::object();
    for (const Quantity& quantity : observer.plan.quantities())
      quantities[quantity.name] = {{"unit", quantity.unit_text},
                                   {"doc", quantity.doc_text},
                                   {"columns", quantity.columns},
                                   {"varying", quantity.varying}};
  }
  fmt::print("{}", document(all));
}

ExitCode list(const Options& options) {
  const auto setup = set_up(options.source, load_plugins(options.source.plugin_folders));
  if (options.json)
    print_json(*setup);
  else
    print_text(*setup);
  return ExitCode::done;
}

}  // namespace

void add_quantity(CLI::App& command, Action& action) {
  auto* const quantity =
      command.add_subcommand("quantity", "Tell about the quantities that the observers of a case record");
  quantity->require_subcommand(0, 1);
  const auto options = std::make_shared<Options>();
  auto* const verb = quantity->add_subcommand(
      "list", "All quantities of a case, as OBSERVER.QUANTITY: form of a sample, unit, meaning; runs nothing");
  add_case(*verb, options->source);
  verb->add_flag("--json", options->json, "For programs; columns: numbers in a row of a table, 0 for a single number");
  verb->callback([&action, options] { action = [options] { return list(*options); }; });
}

}  // namespace mesogen::app
