#include "plugin_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>

#include "case/toml_text.hpp"

namespace mesogen::app {

namespace {

class Text {
 public:
  template <class... Arguments>
  void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
    text_ += '\n';
  }
  /// A name with its facts, and below them what it means.
  void item(const std::string& name, const std::string& facts, const std::string& meaning) {
    line("  {:<24} {}", name, facts);
    if (!meaning.empty()) line("  {:<24} {}", "", meaning);
  }
  void list(std::string_view what, const std::vector<std::string>& names) {
    if (!names.empty()) line("{}: {}", what, fmt::join(names, ", "));
  }
  [[nodiscard]] const std::string& str() const { return text_; }

 private:
  std::string text_;
};

std::string unit(const std::string& text) { return text == "1" ? "" : ", in " + text; }

void tell_keys(Text& text, const PluginFacts& plugin) {
  if (plugin.keys.empty()) {
    text.line("parameters: none");
    return;
  }
  text.line("parameters, keys of {}:", place_in_case(plugin.kind));
  for (const auto& [parameter, default_value] : plugin.keys) {
    std::string facts = parameter.type_text() + unit(parameter.unit_text);
    if (const auto range = parameter.range_text(); !range.empty()) facts += ", " + range;
    if (parameter.is_required) facts += ", required";
    if (!parameter.condition_key.empty()) facts += ", only with " + parameter.condition_text();
    if (parameter.given) facts += ", as the field " + parameter.field_name + " if it varies";
    if (default_value) facts += ", default " + inline_text(*default_value);
    text.item(parameter.name, facts, parameter.doc_text);
  }
}

void tell_shape(Text& text, const sph::KernelShape& shape) {
  text.line("support: {} h", shape.support());
  text.line("form, q = r / h, not normalised: sum of");
  for (const auto& piece : shape.pieces)
    for (std::size_t n = 0; n < piece.coefficients.size(); ++n)
      text.line("  {:>14.8g} ({} - q)_+^{}", piece.coefficients[n], piece.knot, shape.power + static_cast<int>(n));
}

void tell_passes(Text& text, const PluginFacts& plugin) {
  if (!plugin.fields.empty()) text.line("{}", plugin.kind == PluginKind::initial ? "sets the fields:" : "fields:");
  for (const auto& field : plugin.fields) {
    const std::string advance = advance_text(field);
    text.item(field.name,
              std::string(to_string(field.rank)) + unit(field.unit_text) + (advance.empty() ? "" : ", " + advance),
              field.doc_text);
  }
  if (!plugin.passes.empty()) text.line("passes, with default parameters:");
  for (const auto& pass : plugin.passes) {
    text.line("  {} (phase {})", pass.name, to_string(pass.phase));
    text.list("    reads", pass.own_reads);
    text.list("    reads at neighbours", pass.neighbour_reads);
    text.list("    reads if present", pass.optional_reads);
    text.list("    writes", pass.write_list);
    text.list("    adds to", pass.accumulate_list);
  }
  text.list("publishes the constants", plugin.constants);
  if (const Transport& flow = plugin.transport; !flow.velocity.empty())
    text.line("moves particles with: {}{}", flow.velocity, flow.shift.empty() ? "" : ", " + flow.shift);
}

void tell_quantities(Text& text, const PluginFacts& plugin) {
  text.list("reads", plugin.reads);
  text.list("reads if present", plugin.reads_if_present);
  for (const auto& [field, otherwise] : plugin.reads_otherwise) text.line("reads without {}: {}", field, otherwise);
  if (plugin.follows) text.line("looks after every step");
  if (!plugin.quantities.empty()) text.line("quantities:");
  for (const auto& quantity : plugin.quantities)
    text.item(quantity.name, form_text(quantity) + unit(quantity.unit_text), quantity.doc_text);
}

}  // namespace

std::string info_text(const PluginFacts& plugin) {
  Text text;
  text.line("{} {} {}: {}", to_string(plugin.kind), plugin.name, plugin.version, plugin.summary);
  text.line("file: {} ({})", plugin.file, plugin.instruction_set);
  text.line("dimensions: {}{}", fmt::join(plugin.dimensions, ", "),
            plugin.any_dimension ? " (it has a form for any that Mesogen is built for)" : "");
  if (plugin.cuda) text.line("has code for CUDA too");
  text.line("plugin interface: {}, built with {}", plugin.abi, plugin.build_tag);
  tell_keys(text, plugin);
  if (plugin.shape) tell_shape(text, *plugin.shape);
  if (!plugin.not_described.empty()) text.line("the rest depends on the case: {}", plugin.not_described);
  tell_passes(text, plugin);
  tell_quantities(text, plugin);
  return text.str();
}

}  // namespace mesogen::app
