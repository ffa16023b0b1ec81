#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>

#include "forecast/advice.hpp"

/// The pieces of advice, each a function that says something or nothing. A new one is declared here, listed in
/// advice.cpp, and followed by a test in tests/framework/forecast/test_advice_*.cpp.
namespace mesogen::rules {

using Rule = std::optional<Advice>(const AdviceInput& input);

// advice_resolution.cpp
Rule core_under_resolved;
Rule core_over_resolved;
Rule few_neighbours;
// advice_sound.cpp
Rule sound_too_slow;
Rule sound_too_fast;
// advice_inertia.cpp
Rule no_inertia;
// advice_walls.cpp
Rule wall_jump;
// advice_cost.cpp
Rule double_precision;
Rule short_step;
Rule large_output;
// advice_activity.cpp
Rule nothing_grows;
Rule no_order;

/// A constant that a plugin published; 0 if none did.
inline double published(const Setup& setup, const char* name) {
  const auto at = setup.scene.constants.find(name);
  return at == setup.scene.constants.end() ? 0.0 : at->second;
}

/// The full key of a physics plugin's parameter, "physics.flow.sound_speed"; empty if no plugin of the case has it.
std::string key_of(const Setup& setup, const std::string& parameter);

/// A setting: "particles.spacing=0.07".
inline std::string setting(const std::string& key, double value) { return fmt::format("{}={:.6g}", key, value); }

}  // namespace mesogen::rules
