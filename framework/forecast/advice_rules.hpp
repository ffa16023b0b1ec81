#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>

#include "forecast/advice.hpp"

/// The pieces of advice, each a function that says something or nothing. A new one is declared here, listed in
/// advice.cpp, and followed by a test in tests/framework/forecast/test_advice_*.cpp.
namespace mesogen::rules {

using Rule = std::optional<Suggestion>(const AdviceInput& input);

// advice_neighbours.cpp
Rule few_neighbours;
// advice_cost.cpp
Rule double_precision;
Rule short_step;
Rule large_output;

/// A setting: "particles.spacing=0.07".
inline std::string setting(const std::string& key, double value) { return fmt::format("{}={:.6g}", key, value); }

}  // namespace mesogen::rules
