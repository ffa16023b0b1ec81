#pragma once

#include <optional>
#include <string>
#include <vector>

#include "forecast/advice.hpp"
#include "forecast/memory.hpp"
#include "forecast/room.hpp"
#include "forecast/steps.hpp"
#include "forecast/timing.hpp"
#include "plugin/registry.hpp"
#include "run/setup.hpp"

namespace mesogen::app {

/// A piece of advice, and what a run would be that follows it.
struct AdviceFacts {
  Suggestion advice;
  std::int64_t particles = 0;
  double steps = 0.0;
  double memory = 0.0;  ///< bytes
  double disk = 0.0;    ///< bytes
};

/// What `mesogen check` finds out about a case.
struct CheckFacts {
  std::vector<SceneNumber> numbers;
  StepForecast steps;
  MemoryForecast memory;
  double memory_available = 0.0;  ///< bytes; 0: unknown
  double frames = 0.0;            ///< stored
  double frame_bytes = 0.0;
  double checkpoints = 0.0;  ///< in the folder at the end
  double checkpoint_bytes = 0.0;
  double disk = 0.0;  ///< frames and checkpoints, bytes
  std::optional<TimeForecast> time;
  std::string not_timed;     ///< why there is no time
  bool breaks_down = false;  ///< within the first steps; not_timed tells how
  Problems problems;         ///< why it cannot be run here
  std::vector<std::string> warnings;
  std::vector<AdviceFacts> advice;
};

/// `timed`: also take some steps. `program`: bytes resident before the case was set up. The setup is used up.
CheckFacts check_facts(Setup& setup, bool timed, double program, const SetUpWith& set_up_with);

/// For people, and for programs.
std::string check_text(const Setup& setup, const PluginRegistry& registry, const CheckFacts& facts);
std::string check_json(const Setup& setup, const PluginRegistry& registry, const CheckFacts& facts);

}  // namespace mesogen::app
