#include <fmt/format.h>

#include <memory>
#include <set>

#include "options.hpp"
#include "plugin_facts.hpp"
#include "verbs.hpp"

namespace mesogen::app {

namespace {

/// Fields that the framework makes for whoever reads them.
std::set<std::string> derived_fields(const Setup& setup) {
  std::set<std::string> derived = setup.graph->derived_for_integration();
  for (std::size_t reader = 0; reader <= setup.observers.size(); ++reader)
    derived.merge(std::set<std::string>(setup.graph->derived_for_reader(reader)));
  return derived;
}

ExitCode list(const CaseOptions& options) {
  const auto setup = set_up(options, load_plugins(options.plugin_folders));
  const auto line = [](std::string_view name, std::string_view form, std::string_view unit, std::string_view owner,
                       std::string_view note) {
    std::string text = fmt::format("{:<26} {:<13} {:<10} {:<18} {}", name, form, unit, owner, note);
    text.erase(text.find_last_not_of(' ') + 1);
    fmt::print("{}\n", text);
  };
  const Units& units = setup->source.units;
  line("FIELD", "RANK", "UNIT", "FROM", "");
  const Transport& flow = setup->graph->transport();
  line("position", to_string(Rank::vector), units.length, "framework",
       flow.velocity.empty() || flow.fixed
           ? "fixed"
           : "advanced with " + flow.velocity + (flow.shift.empty() ? "" : " + " + flow.shift));
  for (const auto& [name, entry] : setup->catalogue.all()) {
    line(name, to_string(entry.declaration.rank), units.text(entry.declaration.unit_text), entry.owner,
         advance_text(entry.declaration));
    if (!entry.declaration.doc_text.empty()) fmt::print("  {}\n", entry.declaration.doc_text);
  }
  for (const auto& name : derived_fields(*setup))
    line(name, fmt::format("{} components", setup->catalogue.components(name)), units.text(setup->catalogue.unit(name)),
         "framework", "computed when read");
  return ExitCode::done;
}

}  // namespace

void add_field(Verb& command) {
  Verb& field = command.verb("field", "Describe the fields of a case");
  const auto options = std::make_shared<CaseOptions>();
  Verb& verb = field.verb("list", "List the fields of a case: rank, unit, plugin, how they advance",
                          [options] { return list(*options); });
  add_case(verb, *options);
}

}  // namespace mesogen::app
