#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "mesogen/plugin/scene.hpp"
#include "mesogen/plugin/step_limits.hpp"

namespace mesogen {

/// A number that tells what kind of scene this is, for `mesogen check`.
struct SceneNumber {
  std::string name;  ///< "active_length", also its key for programs
  double value = 0.0;
  std::string unit;     ///< SI unit; "1" where it has none
  std::string meaning;  ///< "l_Q = sqrt(K / |zeta|)"
};

/// Something that would be better otherwise, for `mesogen check`. A test follows each piece of advice and finds what it
/// promises.
struct Suggestion {
  std::string name;                   ///< "core_under_resolved"
  std::string finding;                ///< how it is
  std::vector<std::string> settings;  ///< what to change, as for --set: "particles.spacing=0.07"; none if no key helps
  std::string gain;                   ///< what that does, and what is lost; without settings: what else helps
};

/// What a plugin gives advice from.
struct AdviceContext {
  const Scene& scene;
  const StepLimits& limits;  ///< on the step, of all plugins
  StepCause binding;         ///< the limit that binds at the start
  bool step_is_given;        ///< by the case: limits do not matter
  std::string section;       ///< of the plugin itself: "physics.flow"
  /// A unit of the case in the place of an SI unit: "pN/um2" for "Pa".
  std::function<std::string(std::string_view si)> unit;
  /// The largest spacing of particles, not above this one, that fits the box, m.
  std::function<double(double at_most)> fitting_spacing;
};

}  // namespace mesogen
