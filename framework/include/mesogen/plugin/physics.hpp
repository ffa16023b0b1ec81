#pragma once

#include "mesogen/plugin/advice.hpp"
#include "mesogen/plugin/context.hpp"
#include "mesogen/plugin/parameters.hpp"
#include "mesogen/plugin/passes.hpp"
#include "mesogen/plugin/scene.hpp"

namespace mesogen {

/// A physics term: parameters, fields and passes. One object for each instance in the case. It is called three times,
/// in the order below; after that, what it declared is called.
class MESOGEN_EXPORT Physics {
 public:
  Physics() = default;
  Physics(const Physics&) = delete;
  Physics& operator=(const Physics&) = delete;
  virtual ~Physics();

  /// Names the keys of its section of the case. Also called without a case, for `plugin info`.
  virtual void parameters(ParameterList& list) = 0;
  /// Tells other plugins what this one brings: adds to scene.constants and raises scene.scales. All plugins are called
  /// in the order of the case, and then once more: the second time the scene has the constants of all, and what the
  /// initial conditions set. So one plugin may tell what follows from another's constants.
  virtual void publish(Scene& scene) const;
  /// Chooses what depends on the scene, and names fields, passes, limits on the step and advice. Refuses, by Error or
  /// BadParameter, what its parameters cannot mean in this scene. For `plugin info` it is called with a sample scene
  /// and default parameters.
  virtual void declare(const Scene& scene, PassList& list) = 0;
};

}  // namespace mesogen
