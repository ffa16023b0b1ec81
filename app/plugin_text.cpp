#include "plugin_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>

namespace mesogen::app {

namespace {

class Text {
 public:
  template <class... Arguments>
  void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
    text_ += '\n';
  }
  [[nodiscard]] const std::string& str() const { return text_; }

 private:
  std::string text_;
};

std::string unit(const std::string& text) { return text == "1" ? "" : ", in " + text; }

void describe(Text& text, const ParameterList& list, std::string_view where) {
  if (list.all().empty()) {
    text.line("parameters: none");
    return;
  }
  text.line("parameters, keys of {}:", where);
  for (const auto& parameter : list.all()) {
    std::string facts = parameter.type_text();
    facts += unit(parameter.unit_text);
    if (const auto range = parameter.range_text(); !range.empty()) facts += ", " + range;
    facts += parameter.is_required ? ", required" : ", default " + parameter.value_text();
    text.line("  {:<24} {}", parameter.name, facts);
    if (!parameter.doc_text.empty()) text.line("  {:<24} {}", "", parameter.doc_text);
  }
}

void describe(Text& text, const Kernel& kernel) {
  const auto shape = kernel.shape();
  text.line("support: {} h", shape.support());
  text.line("form, q = r / h, not normalised: sum of");
  for (const auto& piece : shape.pieces)
    for (std::size_t n = 0; n < piece.coefficients.size(); ++n)
      text.line("  {:>14.8g} ({} - q)_+^{}", piece.coefficients[n], piece.knot, shape.power + static_cast<int>(n));
}

std::string_view to_text(Phase phase) {
  switch (phase) {
    case Phase::begin: return "begin";
    case Phase::rates: return "rates";
    case Phase::end: return "end";
  }
  return "";
}

void describe(Text& text, Physics& physics) {
  PassList list;
  physics.passes(list);
  if (!list.fields().empty()) text.line("fields:");
  for (const auto& field : list.fields()) {
    const std::string advanced = field.advance == Advance::never ? "" : ", advanced with " + field.rate;
    text.line("  {:<24} {}{}{}", field.name, to_string(field.rank), unit(field.unit_text), advanced);
    if (!field.doc_text.empty()) text.line("  {:<24} {}", "", field.doc_text);
  }
  if (!list.passes().empty()) text.line("passes, with default parameters:");
  for (const auto& pass : list.passes()) {
    text.line("  {} (phase {})", pass.name, to_text(pass.phase));
    const auto fields = [&](std::string_view what, const std::vector<std::string>& names) {
      if (!names.empty()) text.line("    {}: {}", what, fmt::join(names, ", "));
    };
    fields("reads", pass.own_reads);
    fields("reads at neighbours", pass.neighbour_reads);
    fields("reads if present", pass.optional_reads);
    fields("writes", pass.write_list);
    fields("adds to", pass.accumulate_list);
  }
  if (!list.velocity().empty()) text.line("moves particles with: {}", list.velocity());
}

void describe(Text& text, Observer& observer) {
  // The plan may depend on the scene; any will do to name fields and quantities.
  Scene scene;
  scene.box = {1.0, 1.0, 0.0};
  scene.spacing = 0.1;
  scene.smoothing_length = 0.13;
  scene.support = 0.4;
  scene.particle_count = 100;
  ObserverPlan plan;
  observer.plan(scene, plan);
  if (!plan.read_list().empty()) text.line("reads: {}", fmt::join(plan.read_list(), ", "));
  if (!plan.optional_list().empty()) text.line("reads if present: {}", fmt::join(plan.optional_list(), ", "));
  text.line("quantities:");
  for (const auto& quantity : plan.quantities()) {
    const std::string form = quantity.columns == 0 ? "one number" : fmt::format("rows of {} numbers", quantity.columns);
    text.line("  {:<24} {}{}", quantity.name, form, unit(quantity.unit_text));
    if (!quantity.doc_text.empty()) text.line("  {:<24} {}", "", quantity.doc_text);
  }
}

}  // namespace

std::string info_text(const PluginRegistry& registry, const LoadedPlugin& plugin) {
  const auto& descriptor = *plugin.descriptor;
  Text text;
  text.line("{} {} {}: {}", to_string(descriptor.kind), descriptor.name, descriptor.version, descriptor.summary);
  text.line("file: {} ({})", plugin.file.string(), plugin.instruction_set);
  ParameterList parameters;
  switch (descriptor.kind) {
    case PluginKind::kernel: {
      const auto kernel = registry.make_kernel(descriptor.name);
      kernel->parameters(parameters);
      describe(text, parameters, "[kernel]");
      describe(text, *kernel);
      break;
    }
    case PluginKind::boundary: {
      const auto boundary = registry.make_boundary(descriptor.name);
      boundary->parameters(parameters);
      describe(text, parameters, "boundary = { type = ..., ... }");
      break;
    }
    case PluginKind::physics: {
      const auto physics = registry.make_physics(descriptor.name, Precision::double_precision, 2);
      physics->parameters(parameters);
      describe(text, parameters, "[physics.NAME]");
      describe(text, *physics);
      break;
    }
    case PluginKind::observer: {
      const auto observer = registry.make_observer(descriptor.name);
      observer->parameters(parameters);
      describe(text, parameters, "[observers.NAME]");
      describe(text, *observer);
      break;
    }
  }
  return text.str();
}

}  // namespace mesogen::app
