#pragma once

#include <vector>

#include "forecast/steps.hpp"
#include "mesogen/export.hpp"
#include "mesogen/plugin/advice.hpp"
#include "run/setup.hpp"

namespace mesogen {

/// What advice is given from.
struct AdviceInput {
  const Setup& setup;
  StepForecast steps;
  double free_disk = 0.0;  ///< bytes; 0: unknown
};

/// All that there is to say of a case: the framework's own advice, then that of the plugins.
MESOGEN_EXPORT std::vector<Suggestion> advice(const AdviceInput& input);

/// Numbers that tell what kind of scene this is, in the units of the case.
MESOGEN_EXPORT std::vector<SceneNumber> scene_numbers(const Setup& setup);

}  // namespace mesogen
