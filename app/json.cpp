#include "json.hpp"

#include <variant>

namespace mesogen::app {

namespace {

struct Converter {
  Json operator()(bool value) const { return value; }
  Json operator()(std::int64_t value) const { return value; }
  Json operator()(double value) const { return value; }
  Json operator()(const std::string& value) const { return value; }
  Json operator()(const Value::Date& value) const { return value.text; }
  Json operator()(const Value::List& list) const {
    Json all = Json::array();
    for (const auto& element : list) all.push_back(to_json(element));
    return all;
  }
  Json operator()(const Value::Table& table) const {
    Json all = Json::object();
    for (const auto& entry : table) all[entry.key] = to_json(entry.value);
    return all;
  }
};

}  // namespace

Json to_json(const Value& value) { return std::visit(Converter{}, value.content); }

// Texts of plugins may hold anything; what is no UTF-8 is replaced, so that the document is well-formed.
std::string document(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace mesogen::app
