#pragma once

#include <functional>
#include <memory>

#include "forecast/steps.hpp"
#include "mesogen/export.hpp"
#include "run/setup.hpp"

namespace mesogen {

/// How long a run will take on this machine, from some of its steps.
struct TimeForecast {
  int threads = 1;
  int timed_steps = 0;
  double start = 0.0;      ///< before the first step, s
  double step = 0.0;       ///< a step without anything that is due only now and then, s
  double sorting = 0.0;    ///< sorting particles anew, s
  double sortings = 0.0;   ///< how often, at half the speed that the case expects, or that at its start
  double observing = 0.0;  ///< all samples and frames, s
  double writing = 0.0;    ///< frames, checkpoints and the results at the end, s; of disks a common speed is assumed
  double wall = 0.0;       ///< all together, s
  double cpu = 0.0;        ///< processor time in it, all threads together, s: less where the machine is shared
};

/// Takes the first steps of the case in this process, for about `budget` seconds, and writes nothing. `start_up`: what
/// this program took until now, s. The setup is used up: its observers have seen the steps. Throws Error(run_failed) if
/// the run breaks down so soon. A run that ends within this time is begun once more, as `set_up_again` makes it.
MESOGEN_EXPORT TimeForecast forecast_time(Setup& setup, const std::function<std::unique_ptr<Setup>()>& set_up_again,
                                          const StepForecast& steps, double start_up, double budget);

}  // namespace mesogen
