#include "reference_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <iterator>

#include "case/declared_sections.hpp"
#include "case/toml_text.hpp"

namespace mesogen::app {

namespace {

constexpr std::string_view introduction =
    "# Reference\n\n"
    "This page lists every key of a case, and every plugin with its parameters, fields, passes and quantities.\n"
    "`mesogen reference` writes it from the declarations that read and check a case; do not edit it.\n"
    "`mesogen schema -o case.schema.json` gives the same to editors. If the first line of a case is\n"
    "`#:schema ./case.schema.json`, an editor completes and checks the case while you write it (taplo, \"Even Better "
    "TOML\").\n";

std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, 1, '\\');
  return text;
}

std::string code(const std::string& text) { return text.empty() ? "" : "`" + text + "`"; }

std::string codes(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "`" : ", `") + name + "`";
  return text;
}

class Page {
 public:
  explicit Page(std::string_view introduction_text) : text_(introduction_text) {}

  template <class... Arguments>
  void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
    text_ += '\n';
  }
  void heading(int level, const std::string& title) {
    line("{}{} {}\n", text_.ends_with("\n\n") ? "" : "\n", std::string(level, '#'), title);
  }
  void table(const std::vector<std::string>& titles) {
    row(titles);
    row(std::vector<std::string>(titles.size(), "---"));
  }
  void row(const std::vector<std::string>& cells) {
    text_ += '|';
    for (const auto& one : cells) text_ += " " + cell(one) + (one.empty() ? "|" : " |");
    text_ += '\n';
  }
  void keys_table() { table({"key", "type", "unit", "range", "default", "meaning"}); }
  void key(const DeclaredKey& declared) {
    const Parameter& p = declared.parameter;
    std::string meaning = p.doc_text;
    if (!p.condition_key.empty()) meaning += (meaning.empty() ? "" : "; ") + ("only with " + code(p.condition_text()));
    row({code(p.name), p.type_text(), p.unit_text == "1" ? "" : p.unit_text, p.range_text(),
         p.is_required ? "required" : (declared.default_value ? code(inline_text(*declared.default_value)) : ""),
         meaning});
  }
  [[nodiscard]] const std::string& str() const { return text_; }

 private:
  std::string text_;
};

void write_section(Page& page, const DeclaredSection& declared) {
  const auto& [section, keys] = declared;
  const std::string name = section.instances ? section.name + ".NAME" : section.name;
  const bool inner = name.find('.') != std::string::npos && !section.instances;
  page.heading(3, name.empty() ? "Title" : (inner ? "`" + name + "`" : "`[" + name + "]`"));
  page.line("{}{}\n", section.doc, section.required || name.empty() ? "" : " May be left out.");
  if (section.plugin == PluginKind::initial) return page.line("Its keys are those of the plugin, below.");
  page.keys_table();
  for (const auto& key : keys) page.key(key);
  if (section.plugin)
    page.line("\nMore keys: those of the {} that `{}` names, below.", to_string(*section.plugin), section.chooser);
}

/// "(3 - q)_+^5 - 6 (2 - q)_+^5"
std::string shape_text(const sph::KernelShape& shape) {
  std::string text;
  for (const auto& [knot, coefficients] : shape.pieces)
    for (std::size_t n = 0; n < coefficients.size(); ++n) {
      const double size = std::abs(coefficients[n]);
      if (size == 0.0) continue;
      const char* sign = coefficients[n] < 0.0 ? (text.empty() ? "-" : " - ") : (text.empty() ? "" : " + ");
      text += fmt::format("{}{}({} - q)_+^{}", sign, size == 1.0 ? "" : fmt::format("{:.8g} ", size), knot,
                          shape.power + static_cast<int>(n));
    }
  return text;
}

void write_passes(Page& page, const PluginFacts& plugin) {
  if (!plugin.fields.empty()) {
    page.line("\n{}:\n", plugin.kind == PluginKind::initial ? "Sets the fields" : "Fields");
    page.table({"field", "rank", "unit", "meaning", "advanced"});
    for (const auto& field : plugin.fields)
      page.row({code(field.name), std::string(to_string(field.rank)), field.unit_text == "1" ? "" : field.unit_text,
                field.doc_text, advance_text(field)});
  }
  if (!plugin.passes.empty()) {
    page.line("\nPasses, with default parameters:\n");
    page.table({"pass", "phase", "reads", "reads at neighbours", "reads if present", "writes", "adds to"});
    for (const auto& pass : plugin.passes)
      page.row({pass.name, std::string(to_string(pass.phase)), codes(pass.own_reads), codes(pass.neighbour_reads),
                codes(pass.optional_reads), codes(pass.write_list), codes(pass.accumulate_list)});
  }
  if (!plugin.constants.empty()) page.line("\nPublishes the constants {}.", codes(plugin.constants));
  if (!plugin.transport.velocity.empty())
    page.line("\nParticles move with {}{}.", code(plugin.transport.velocity),
              plugin.transport.shift.empty() ? "" : " and " + code(plugin.transport.shift));
}

void write_quantities(Page& page, const PluginFacts& plugin) {
  if (!plugin.reads.empty()) page.line("\nReads {}.", codes(plugin.reads));
  if (!plugin.reads_if_present.empty()) page.line("\nReads {} if present.", codes(plugin.reads_if_present));
  for (const auto& [field, otherwise] : plugin.reads_otherwise)
    page.line("\nReads {} if there is no {}.", code(otherwise), code(field));
  if (plugin.quantities.empty()) return;
  page.line("\nQuantities:\n");
  page.table({"quantity", "form", "unit", "meaning"});
  for (const auto& quantity : plugin.quantities)
    page.row({code(quantity.name), form_text(quantity), quantity.unit_text == "1" ? "" : quantity.unit_text,
              quantity.doc_text});
}

void write_plugin(Page& page, const PluginFacts& plugin) {
  page.heading(3, fmt::format("{} {}", plugin.name, plugin.version));
  page.line("{}.", plugin.summary);
  if (plugin.shape) page.line("\nForm, with q = r / h, not normalised: `{}`", shape_text(*plugin.shape));
  if (plugin.keys.empty()) {
    page.line("\nNo parameters.");
  } else {
    page.line("\nParameters:\n");
    page.keys_table();
    for (const auto& key : plugin.keys) page.key(key);
  }
  if (!plugin.not_described.empty()) page.line("\nThe rest depends on the case: {}.", plugin.not_described);
  write_passes(page, plugin);
  write_quantities(page, plugin);
}

std::string title_of(PluginKind kind) {
  switch (kind) {
    case PluginKind::kernel: return "Kernels";
    case PluginKind::boundary: return "Boundaries";
    case PluginKind::shape: return "Shapes";
    case PluginKind::initial: return "Initial conditions";
    case PluginKind::physics: return "Physics";
    case PluginKind::observer: return "Observers";
  }
  return "";
}

}  // namespace

std::string reference_text(const std::vector<PluginFacts>& plugins) {
  Page page(introduction);
  page.heading(2, "The case");
  page.line("A TOML file. Keys with a dot, such as `bulk.A`, stand in a table: `bulk = {{ A = -1.0 }}`.");
  for (const auto& section : declared_sections()) write_section(page, section);
  for (const auto kind : plugin_kinds) {
    page.heading(2, title_of(kind));
    for (const auto& plugin : plugins)
      if (plugin.kind == kind) write_plugin(page, plugin);
  }
  return page.str();
}

}  // namespace mesogen::app
