#pragma once

#include <cstdint>
#include <string>

#include "mesogen/export.hpp"
#include "simulation/setup.hpp"

namespace mesogen {

/// How many steps a run will take. Where the step is chosen as the run goes, it shortens as the flow speeds up, so both
/// counts are the least that it can take.
struct StepForecast {
  double first = 0.0;        ///< size of a step of the fluid at rest, s; infinite if nothing limits it
  std::string limit;         ///< what binds then
  std::int64_t at_rest = 0;  ///< steps if the flow never binds
  double speed = 0.0;        ///< that the case expects, m/s; 0: it names none
  double at_speed = 0.0;     ///< size of a step at that speed, s
  std::string limit_at_speed;
  std::int64_t expected = 0;  ///< steps at that speed, or else those at rest
  bool fixed = false;         ///< the case names the step
};

MESOGEN_EXPORT StepForecast forecast_steps(const Setup& setup);

}  // namespace mesogen
