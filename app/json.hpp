#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "case/value.hpp"

namespace mesogen::app {

/// Keys stay in the order in which they were put in.
using Json = nlohmann::ordered_json;

Json to_json(const Value& value);
/// A whole document, ending in a line break.
std::string document(const Json& json);

}  // namespace mesogen::app
