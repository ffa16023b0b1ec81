#pragma once

#include <string>
#include <vector>

#include "forecast/steps.hpp"
#include "mesogen/export.hpp"
#include "simulation/setup.hpp"

namespace mesogen {

/// Something that would be better otherwise. A test of each piece follows it and finds what it promises.
struct Advice {
  std::string name;                   ///< "core_under_resolved"
  std::string finding;                ///< how it is
  std::vector<std::string> settings;  ///< what to do, as for --set: "particles.spacing=0.07"; none if no key helps
  std::string gain;                   ///< what that does; without settings: what else helps
};

/// What advice is given from.
struct AdviceInput {
  const Setup& setup;
  StepForecast steps;
  double free_disk = 0.0;  ///< bytes; 0: unknown
};

/// All that there is to say of a case.
MESOGEN_EXPORT std::vector<Advice> advice(const AdviceInput& input);

}  // namespace mesogen
