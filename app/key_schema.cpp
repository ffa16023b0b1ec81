#include "key_schema.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

namespace mesogen::app {

namespace {

/// The type of the values, element by element.
class TypeWriter {
 public:
  explicit TypeWriter(const Parameter& parameter) : parameter_(parameter) {}

  Json operator()(const double*) const { return varying(number("number")); }
  Json operator()(const std::optional<double>*) const {
    if (parameter_.word.empty()) return number("number");
    return {{"anyOf", {number("number"), {{"const", parameter_.word}}}}};
  }
  Json operator()(const WordOrNumber*) const {
    return {{"anyOf", {number("number"), {{"enum", parameter_.word_list}}}}};
  }
  Json operator()(const std::int64_t*) const { return number("integer"); }
  Json operator()(const bool*) const { return {{"type", "boolean"}}; }
  Json operator()(const std::string*) const { return text(); }
  Json operator()(const std::vector<double>*) const { return sized_list(); }
  Json operator()(const std::vector<std::string>*) const { return {{"type", "array"}, {"items", text()}}; }
  Json operator()(const Parameter::Rows*) const { return {{"type", "array"}, {"items", sized_list()}}; }

 private:
  /// An expression or an image in place of a number that may vary.
  [[nodiscard]] Json varying(Json number) const {
    if (!parameter_.given) return number;
    const Json texts = {{"type", "array"}, {"items", {{"type", "string"}}}};
    const Json times = {{"type", "array"}, {"items", {{"type", "number"}}}};
    const Json keys = {{"image", {{"anyOf", {{{"type", "string"}}, texts}}}},
                       {"low", {{"type", "number"}}},
                       {"high", {{"type", "number"}}},
                       {"times", times}};
    const Json image = {{"type", "object"},
                        {"properties", keys},
                        {"required", {"image", "low", "high"}},
                        {"additionalProperties", false}};
    return {{"anyOf", {std::move(number), {{"type", "string"}}, image}}};
  }
  [[nodiscard]] Json number(const char* type) const {
    Json schema = {{"type", type}};
    const auto& p = parameter_;
    if (std::isfinite(p.lowest)) schema[p.lowest_excluded ? "exclusiveMinimum" : "minimum"] = p.lowest;
    if (std::isfinite(p.highest)) schema[p.highest_excluded ? "exclusiveMaximum" : "maximum"] = p.highest;
    return schema;
  }
  [[nodiscard]] Json text() const {
    Json schema = {{"type", "string"}};
    if (!parameter_.choice_list.empty()) schema["enum"] = parameter_.choice_list;
    return schema;
  }
  [[nodiscard]] Json sized_list() const {
    Json schema = {{"type", "array"}, {"items", varying(number("number"))}};
    Json sizes = Json::array();
    for (const auto size : parameter_.size_list) sizes.push_back({{"minItems", size}, {"maxItems", size}});
    if (sizes.size() == 1) schema.update(sizes.front());
    if (sizes.size() > 1) schema["anyOf"] = sizes;
    return schema;
  }

  const Parameter& parameter_;
};

std::string description(const Parameter& parameter) {
  std::string text = parameter.doc_text;
  if (parameter.unit_text != "1") text += (text.empty() ? "in " : ", in ") + parameter.unit_text;
  return text;
}

Json condition_value(const std::string& word) {
  if (word == "true" || word == "false") return word == "true";
  return word;
}

/// Holds where the condition of a key does: `other` is the key that it names.
Json condition_schema(const Parameter& parameter, const DeclaredKey& other) {
  Json values = Json::array();
  bool by_default = false;
  for (const auto& word : parameter.condition_values) {
    values.push_back(condition_value(word));
    by_default = by_default || (other.default_value && to_json(*other.default_value) == values.back());
  }
  Json schema = {{"properties", {{parameter.condition_key, {{"enum", values}}}}}};
  if (!by_default) schema["required"] = Json::array({parameter.condition_key});
  return schema;
}

/// What keys ask of each other: a key with a condition must be there if it is required, and must not if it does not
/// hold.
Json conditions(const std::vector<DeclaredKey>& keys) {
  Json all = Json::array();
  for (const auto& key : keys) {
    const Parameter& parameter = key.parameter;
    if (parameter.condition_key.empty()) continue;
    const auto other =
        std::ranges::find_if(keys, [&](const DeclaredKey& k) { return k.parameter.name == parameter.condition_key; });
    // A key in a table of its own, "bulk.A", cannot be asked for from here.
    if (other == keys.end() || parameter.name.find('.') != std::string::npos) continue;
    const Json there = {{"required", Json::array({parameter.name})}};
    Json one = {{"if", condition_schema(parameter, *other)}, {"else", {{"not", there}}}};
    if (parameter.is_required) one["then"] = there;
    all.push_back(std::move(one));
  }
  return all;
}

/// The keys under one name: itself, or those of the table "bulk" as A, B, C.
std::vector<DeclaredKey> inner_keys(const std::vector<DeclaredKey>& keys, const std::string& table) {
  std::vector<DeclaredKey> inner;
  for (const auto& key : keys) {
    if (!key.parameter.name.starts_with(table + ".")) continue;
    inner.push_back(key);
    inner.back().parameter.name.erase(0, table.size() + 1);
  }
  return inner;
}

}  // namespace

Json key_schema(const DeclaredKey& key) {
  Json schema = Json::object();
  if (const auto text = description(key.parameter); !text.empty()) schema["description"] = text;
  schema.update(std::visit(TypeWriter(key.parameter), key.parameter.target));
  if (key.default_value) schema["default"] = to_json(*key.default_value);
  return schema;
}

Json table_schema(const std::vector<DeclaredKey>& keys) {
  Json properties = Json::object();
  Json required = Json::array();
  for (const auto& key : keys) {
    const std::string name = key.parameter.name.substr(0, key.parameter.name.find('.'));
    if (properties.contains(name)) continue;
    const bool is_table = name != key.parameter.name;
    properties[name] = is_table ? table_schema(inner_keys(keys, name)) : key_schema(key);
    const bool needed = key.parameter.is_required && key.parameter.condition_key.empty();
    if (is_table ? properties[name].contains("required") : needed) required.push_back(name);
  }
  Json schema = {{"type", "object"}, {"properties", properties}};
  if (!required.empty()) schema["required"] = required;
  if (Json all = conditions(keys); !all.empty()) schema["allOf"] = std::move(all);
  schema["additionalProperties"] = false;
  return schema;
}

}  // namespace mesogen::app
