#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "case/problems.hpp"
#include "forecast/memory.hpp"
#include "forecast/steps.hpp"
#include "mesogen/export.hpp"
#include "run/setup.hpp"

/// What of a run is more than this machine has: told before anything is written, with what would fit.
namespace mesogen {

/// The same case with these settings, as by --set; throws Error if they do not go with it.
using SetUpWith = std::function<std::unique_ptr<Setup>(const std::vector<std::string>& settings)>;

/// A spacing with which a case fits the memory.
struct MESOGEN_EXPORT Fitting {
  double spacing = 0.0;    ///< m
  double particles = 0.0;  ///< about
};

/// From what a particle takes in a coarse copy of the case, of 2e5 particles at most; leaves a tenth of `available`,
/// bytes, free. `program`: as for forecast_memory(). Nothing if there is no such copy, or no particle fits.
MESOGEN_EXPORT std::optional<Fitting> fitting(const Case& source, double available, double program,
                                              const SetUpWith& set_up_with);

/// Refuses a case of which a coarse copy tells that it takes three times what is available or more: setting it up would
/// itself take too much. Others are left to refuse_beyond_memory().
MESOGEN_EXPORT void refuse_far_beyond_memory(const Case& source, double available, double program,
                                             const SetUpWith& set_up_with, Problems& problems);

/// Refuses a case whose run takes more memory than is available, bytes, or whose samples, which are kept until the end,
/// take more than half of it.
MESOGEN_EXPORT void refuse_beyond_memory(const Setup& setup, const MemoryForecast& memory, double available,
                                         double program, const SetUpWith& set_up_with, Problems& problems);

/// Beyond 2^53 steps a step is less than the rounding of the time that it is added to: the end is never reached.
MESOGEN_EXPORT bool time_stands_still(const StepForecast& steps);

/// That a run takes more than 1e9 steps, and why; empty if it does not.
MESOGEN_EXPORT std::string beyond_steps(const Setup& setup, const StepForecast& steps);

}  // namespace mesogen
