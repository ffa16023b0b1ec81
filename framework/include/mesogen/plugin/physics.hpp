#pragma once

#include "mesogen/plugin/advice.hpp"
#include "mesogen/plugin/context.hpp"
#include "mesogen/plugin/parameters.hpp"
#include "mesogen/plugin/passes.hpp"
#include "mesogen/plugin/scene.hpp"

namespace mesogen {

/// A physics term: parameters, fields and passes. There is one object for each instance in the case. The framework
/// calls the three functions in the order below; during the run it calls only what declare() has registered.
class MESOGEN_EXPORT Physics {
 public:
  Physics() = default;
  Physics(const Physics&) = delete;
  Physics& operator=(const Physics&) = delete;
  virtual ~Physics();

  /// Names the keys of the plugin's section of the case. Also called without a case, for `plugin info`.
  virtual void parameters(ParameterList& list) = 0;
  /// Tells other plugins what this plugin brings: adds to scene.constants and raises scene.scales. All plugins are
  /// called twice, each time in the order of the case. The second time the scene has the constants of all plugins and
  /// what the initial conditions set, so a plugin may publish what follows from another plugin's constants.
  virtual void publish(Scene& scene) const;
  /// May be called several times, with Scene::stabilised_steps false or true and an empty list each time. Only the last
  /// call counts, so it must set every member anew. Makes all choices that depend on the scene, and declares fields,
  /// passes, limits on the step and advice. Throws Error or BadParameter if the parameters make no sense in this scene.
  /// For `plugin info` it is called with a sample scene and default parameters.
  virtual void declare(const Scene& scene, PassList& list) = 0;
};

}  // namespace mesogen
