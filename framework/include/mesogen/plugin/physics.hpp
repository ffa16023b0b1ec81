#pragma once

#include "mesogen/plugin/context.hpp"
#include "mesogen/plugin/parameters.hpp"
#include "mesogen/plugin/passes.hpp"
#include "mesogen/plugin/scene.hpp"

namespace mesogen {

/// A physics term: parameters, fields and passes. One object an instance in the case. Calls come in the order below.
class MESOGEN_EXPORT Physics {
 public:
  Physics() = default;
  Physics(const Physics&) = delete;
  Physics& operator=(const Physics&) = delete;
  virtual ~Physics();

  /// Names the keys of its section of the case. Also called without a case, for `plugin info`.
  virtual void parameters(ParameterList& list) = 0;
  /// Says what magnitudes it brings to the scene. Parameters are set.
  virtual void scales(Scales& scales) const;
  /// Numbers that others may want, by name: constants["elastic_constant"] = 0.02. Called again after prepare(), for
  /// observers and for what the program tells of a case: there may be more to say then.
  virtual void constants(Constants& constants) const;
  /// Chooses what depends on the scene and on what the other plugins said in scales() and constants().
  virtual void prepare(const Scene& scene);
  /// Names fields and passes; may depend on parameters. Also called with default parameters, for `plugin info`.
  virtual void passes(PassList& list) = 0;
  /// Limits on the step that stay the same over the run.
  virtual void step_limits(const Scene& scene, StepLimits& limits) const;
};

}  // namespace mesogen
