#pragma once

#include <optional>
#include <string>

#include "case/value.hpp"
#include "mesogen/plugin/parameters.hpp"

namespace mesogen {

/// Why a value was not taken, and which part of it is to blame.
struct Refusal {
  SourcePlace place;
  std::string text;
};

/// Writes a value to a parameter's target if its type and range are right; else leaves the target as it is.
std::optional<Refusal> take_value(const Parameter& parameter, const Value& value);

/// What the target holds now; nothing where TOML has no word for it (an optional number without a value or a word,
/// or a number that is not finite).
std::optional<Value> current_value(const Parameter& parameter);

/// "a number in Pa s, > 0", "a list of 2 numbers in m, each > 0"
std::string expected_text(const Parameter& parameter);

}  // namespace mesogen
