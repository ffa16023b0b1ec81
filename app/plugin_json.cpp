#include "plugin_json.hpp"

#include "json.hpp"
#include "key_schema.hpp"

namespace mesogen::app {

namespace {

Json keys_json(const PluginFacts& plugin) {
  Json all = Json::array();
  for (const auto& key : plugin.keys) {
    const Parameter& parameter = key.parameter;
    Json one = {
        {"name", parameter.name},          {"type", parameter.type_text()},     {"unit", parameter.unit_text},
        {"range", parameter.range_text()}, {"required", parameter.is_required}, {"meaning", parameter.doc_text}};
    if (!parameter.condition_key.empty())
      one["only_with"] = {{"key", parameter.condition_key}, {"values", parameter.condition_values}};
    if (key.default_value) one["default"] = to_json(*key.default_value);
    one["schema"] = key_schema(key);
    all.push_back(std::move(one));
  }
  return all;
}

Json shape_json(const sph::KernelShape& shape) {
  Json pieces = Json::array();
  for (const auto& piece : shape.pieces) pieces.push_back({{"knot", piece.knot}, {"coefficients", piece.coefficients}});
  return {{"support", shape.support()}, {"power", shape.power}, {"pieces", pieces}};
}

Json fields_json(const PluginFacts& plugin) {
  Json all = Json::array();
  for (const auto& field : plugin.fields) {
    Json one = {
        {"name", field.name}, {"rank", to_string(field.rank)}, {"unit", field.unit_text}, {"meaning", field.doc_text}};
    if (field.advance != Advance::never) {
      one["advanced"] = field.advance == Advance::predicted ? "predicted and corrected" : "midpoint";
      one["rate"] = field.rate;
    }
    all.push_back(std::move(one));
  }
  return all;
}

Json passes_json(const PluginFacts& plugin) {
  Json all = Json::array();
  for (const auto& pass : plugin.passes)
    all.push_back({{"name", pass.name},
                   {"phase", to_string(pass.phase)},
                   {"reads", pass.own_reads},
                   {"reads_neighbours", pass.neighbour_reads},
                   {"reads_if_present", pass.optional_reads},
                   {"writes", pass.write_list},
                   {"accumulates", pass.accumulate_list}});
  return all;
}

Json quantities_json(const PluginFacts& plugin) {
  Json all = Json::array();
  for (const auto& quantity : plugin.quantities)
    all.push_back({{"name", quantity.name},
                   {"unit", quantity.unit_text},
                   {"columns", quantity.columns},
                   {"varying", quantity.varying},
                   {"meaning", quantity.doc_text}});
  return all;
}

Json plugin_json(const PluginFacts& plugin) {
  Json one = {{"kind", to_string(plugin.kind)},
              {"name", plugin.name},
              {"version", plugin.version},
              {"summary", plugin.summary},
              {"file", plugin.file},
              {"instruction_set", plugin.instruction_set},
              {"dimensions", plugin.dimensions},
              {"cuda", plugin.cuda},
              {"abi", plugin.abi},
              {"build_tag", plugin.build_tag},
              {"parameters", keys_json(plugin)}};
  if (!plugin.not_described.empty()) one["not_described"] = plugin.not_described;
  if (plugin.shape) one["shape"] = shape_json(*plugin.shape);
  if (plugin.kind == PluginKind::initial) one["sets"] = fields_json(plugin);
  if (plugin.kind == PluginKind::physics) {
    one["fields"] = fields_json(plugin);
    one["passes"] = passes_json(plugin);
    one["constants"] = plugin.constants;
    one["moves_particles"] = {{"velocity", plugin.transport.velocity}, {"shift", plugin.transport.shift}};
  }
  if (plugin.kind == PluginKind::observer) {
    one["reads"] = plugin.reads;
    one["reads_if_present"] = plugin.reads_if_present;
    one["reads_otherwise"] = plugin.reads_otherwise;
    one["every_step"] = plugin.follows;
    one["quantities"] = quantities_json(plugin);
  }
  return one;
}

}  // namespace

std::string list_json(const PluginRegistry& registry) {
  Json plugins = Json::array();
  for (const auto& [descriptor, file, instruction_set] : registry.all())
    plugins.push_back({{"kind", to_string(descriptor->kind)},
                       {"name", descriptor->name},
                       {"version", descriptor->version},
                       {"summary", descriptor->summary},
                       {"dimensions", usable_dimensions(*descriptor).list()},
                       {"file", file.string()},
                       {"instruction_set", instruction_set}});
  Json refused = Json::array();
  for (const auto& [file, reason] : registry.refused())
    refused.push_back({{"file", file.string()}, {"reason", reason}});
  return document({{"plugins", plugins}, {"refused", refused}});
}

std::string info_json(const std::vector<PluginFacts>& plugins) {
  Json all = Json::array();
  for (const auto& plugin : plugins) all.push_back(plugin_json(plugin));
  return document({{"plugins", all}});
}

}  // namespace mesogen::app
