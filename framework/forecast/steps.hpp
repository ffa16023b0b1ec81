#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "mesogen/export.hpp"
#include "mesogen/plugin/step_limits.hpp"
#include "run/setup.hpp"

namespace mesogen {

/// How many steps a run will take. Where the step is chosen as the run goes, it shortens as the flow speeds up, so both
/// counts are the least that it can take. Steps are cut to end on the times asked for, as in a run. The counts are
/// whole numbers; infinite where they are beyond all numbers.
struct StepForecast {
  double first = 0.0;  ///< size of a step of the fluid at rest, s; infinite if nothing limits it
  std::string limit;   ///< what binds then, in words
  StepCause cause = StepCause::nothing;
  double at_rest = 0.0;   ///< steps if the flow never binds
  double speed = 0.0;     ///< that the case expects, m/s; 0: it names none
  double at_speed = 0.0;  ///< size of a step at that speed, s
  std::string limit_at_speed;
  double expected = 0.0;  ///< steps at that speed, or else those at rest
  bool fixed = false;     ///< the case names the step
  /// By field, the stages of a stabilised step of that size; empty where steps are explicit.
  std::map<std::string, int> stages = {};
};

MESOGEN_EXPORT StepForecast forecast_steps(const Setup& setup);

/// How often a reader is due in so many steps, beside the start: an observer by its number, the output after the last.
MESOGEN_EXPORT double times_due(const Setup& setup, std::size_t reader, double steps);

/// Frames that a run stores.
MESOGEN_EXPORT double frames_stored(const Setup& setup);

/// Checkpoints that it keeps for good.
MESOGEN_EXPORT double checkpoints_kept(const Setup& setup);

/// Checkpoints that lie in the folder of a run at its end: the newest two, those that are kept for good, and that
/// before the end where no sample, frame or kept checkpoint is asked for there.
MESOGEN_EXPORT double checkpoints_stored(const Setup& setup);

}  // namespace mesogen
