#include "case_schema.hpp"

#include <optional>
#include <string>

#include "case/declared_sections.hpp"
#include "json.hpp"
#include "key_schema.hpp"

namespace mesogen::app {

namespace {

/// One of several forms that a table takes, and the value of a key by which it is known.
struct Branch {
  std::string name;
  Json condition;
  std::vector<DeclaredKey> keys;
};

class SchemaBuilder {
 public:
  explicit SchemaBuilder(const std::vector<PluginFacts>& plugins) : plugins_(plugins) {}

  Json build() {
    Json properties = Json::object();
    Json required = Json::array();
    for (const auto& section : declared_sections()) put(section, properties, required);
    return {{"$schema", "http://json-schema.org/draft-07/schema#"},
            {"title", "A case of Mesogen"},
            {"type", "object"},
            {"properties", properties},
            {"required", required},
            {"additionalProperties", false},
            {"definitions", definitions_}};
  }

 private:
  void put(const DeclaredSection& declared, Json& properties, Json& required) {
    const auto& [section, keys] = declared;
    if (section.name.empty()) {
      properties.update(table_schema(keys)["properties"]);
      return;
    }
    if (section.plugin == PluginKind::initial) return put_initial(properties);
    // "domain.boundary" goes into the table of `domain`, which comes before it.
    const auto dot = section.name.find('.');
    const bool inner = dot != std::string::npos;
    Json& table = inner ? properties[section.name.substr(0, dot)] : properties;
    const std::string key = inner ? section.name.substr(dot + 1) : section.name;
    Json schema = {{"description", section.doc}};
    schema.update(section.plugin ? plugin_schema(declared) : table_schema(keys));
    (inner ? table["properties"] : table)[key] = std::move(schema);
    if (section.required) (inner ? table["required"] : required).push_back(key);
  }

  /// Initial conditions have a section each, called after the plugin.
  void put_initial(Json& properties) {
    for (const auto& plugin : plugins_) {
      if (plugin.kind != PluginKind::initial) continue;
      const std::string name = std::string(to_string(plugin.kind)) + "." + plugin.name;
      definitions_[name] = table_schema(plugin.keys);
      const Json reference = {{"$ref", "#/definitions/" + name}};
      properties[plugin.name] = {{"description", plugin.summary}, {"allOf", Json::array({reference})}};
    }
  }

  Json plugin_schema(const DeclaredSection& declared) {
    const PluginKind kind = *declared.section.plugin;
    const auto& own = declared.keys;
    DeclaredKey type = own.front();
    std::vector<std::string> by_name;  // boundaries whose name is enough
    std::vector<Branch> branches;
    for (const auto& plugin : plugins_) {
      if (plugin.kind != kind) continue;
      type.parameter.choice_list.push_back(plugin.name);
      auto keys = own;
      keys.front().parameter.choices({plugin.name}).doc(plugin.summary);
      keys.insert(keys.end(), plugin.keys.begin(), plugin.keys.end());
      Json condition = {{"type", "object"},
                        {"properties", {{declared.section.chooser, {{"const", plugin.name}}}}},
                        {"required", Json::array({declared.section.chooser})}};
      branches.push_back({std::string(to_string(kind)) + "." + plugin.name, condition, keys});
      if (!table_schema(plugin.keys).contains("required")) by_name.push_back(plugin.name);
    }
    Json table = choice_schema(type, branches);
    if (kind == PluginKind::observer) table["not"] = {{"required", {"interval", "every"}}};
    if (kind == PluginKind::boundary) return {{"anyOf", {Json{{"type", "string"}, {"enum", by_name}}, table}}};
    if (!declared.section.instances) return table;
    Json named = {
        {"type", "object"}, {"patternProperties", {{"^[A-Za-z0-9_-]+$", table}}}, {"additionalProperties", false}};
    if (declared.section.required) named["minProperties"] = 1;
    return named;
  }

  /// A table whose keys follow from the one that chooses. The conditions make for exact complaints; editors that do
  /// not follow them find the keys by `anyOf`, which lets everything pass.
  Json choice_schema(const DeclaredKey& chooser, const std::vector<Branch>& branches) {
    Json conditions = Json::array();
    Json all = Json::array({Json::object()});
    for (const auto& branch : branches) {
      definitions_[branch.name] = table_schema(branch.keys);
      const Json reference = {{"$ref", "#/definitions/" + branch.name}};
      conditions.push_back({{"if", branch.condition}, {"then", reference}});
      all.push_back(reference);
    }
    Json schema = {{"type", "object"}, {"properties", {{chooser.parameter.name, key_schema(chooser)}}}};
    if (chooser.parameter.is_required) schema["required"] = Json::array({chooser.parameter.name});
    if (!branches.empty()) schema["allOf"] = conditions;
    schema["anyOf"] = all;
    return schema;
  }

  const std::vector<PluginFacts>& plugins_;
  Json definitions_ = Json::object();
};

}  // namespace

std::string case_schema(const std::vector<PluginFacts>& plugins) { return document(SchemaBuilder(plugins).build()); }

}  // namespace mesogen::app
