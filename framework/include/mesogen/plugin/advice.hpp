#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "mesogen/plugin/scene.hpp"
#include "mesogen/plugin/step_limits.hpp"

namespace mesogen {

/// A number that characterises the scene. `mesogen check` prints it.
struct SceneNumber {
  std::string name;  ///< "active_length"; also its key in the output for programs
  double value = 0.0;
  std::string unit;     ///< SI unit; "1" if it has none
  std::string meaning;  ///< "l_Q = sqrt(K / |zeta|)"
};

/// Advice on how to improve a case. `mesogen check` prints it. Each kind of advice has a test that follows it and
/// checks what it promises.
struct Suggestion {
  std::string name;                   ///< "core_under_resolved"
  std::string finding;                ///< what is not good in this case
  std::vector<std::string> settings;  ///< changes, as for --set: "particles.spacing=0.07"; empty if no key helps
  std::string gain;                   ///< what the changes gain and cost; if `settings` is empty: what else helps
};

/// What a plugin knows when it gives advice.
struct AdviceContext {
  const Scene& scene;
  const StepLimits& limits;  ///< limits on the step, of all plugins
  StepCause binding;         ///< cause of the smallest limit at the start
  bool step_is_given;        ///< true if the case gives the step: limits are then not used
  std::string section;       ///< section of this plugin: "physics.flow"
  /// Returns the unit of the case for an SI unit: "pN/um2" for "Pa".
  std::function<std::string(std::string_view si)> unit;
  /// Returns the largest particle spacing that fits the box and is at most `at_most`, m.
  std::function<double(double at_most)> fitting_spacing;
};

}  // namespace mesogen
