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

void add_quantity(Verb& command) {
  Verb& quantity = command.verb("quantity", "Describe the quantities that the observers of a case record");
  const auto options = std::make_shared<Options>();
  Verb& verb = quantity.verb("list", "List the quantities as OBSERVER.QUANTITY: form, unit and meaning; runs nothing",
                             [options] { return list(*options); });
  add_case(verb, options->source);
  verb.flag("--json", &options->json, "Print JSON, for programs; columns: numbers in a row, 0 for a single number");
}

}  // namespace mesogen::app
