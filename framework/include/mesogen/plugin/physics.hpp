#pragma once

#include <string>
#include <vector>

#include "mesogen/plugin/context.hpp"
#include "mesogen/plugin/parameters.hpp"
#include "mesogen/plugin/passes.hpp"
#include "mesogen/plugin/scene.hpp"

namespace mesogen {

/// Another way to compute a scene, for `mesogen check` to tell of.
struct Suggestion {
  std::string name;                   ///< "no_sound"
  std::string finding;                ///< how it is
  std::vector<std::string> settings;  ///< keys of the plugin's own section: "type=incompressible"
  std::string gain;                   ///< what that does, and what is lost
};

/// A physics term: parameters, fields and passes. One object an instance in the case. Calls come in the order below.
class MESOGEN_EXPORT Physics {
 public:
  Physics() = default;
  Physics(const Physics&) = delete;
  Physics& operator=(const Physics&) = delete;
  virtual ~Physics();

  /// Names the keys of its section of the case. Also called without a case, for `plugin info`.
  virtual void parameters(ParameterList& list) = 0;
  /// Says what magnitudes it brings to the scene. Parameters are set; the scene has the constants of all plugins, and
  /// the distortion at the start.
  virtual void scales(const Scene& scene, Scales& scales) const;
  /// Numbers that others may want, by name: constants["elastic_constant"] = 0.02. Called again after every plugin's
  /// prepare(), for step_limits(), passes and observers: there may be more to say then, or something else.
  virtual void constants(Constants& constants) const;
  /// Chooses what depends on the scene and on what the other plugins said in scales() and constants().
  virtual void prepare(const Scene& scene);
  /// Names fields and passes; may depend on parameters. Also called with default parameters, for `plugin info`.
  virtual void passes(PassList& list) = 0;
  /// Limits on the step that stay the same over the run, or until a watch changes something: see
  /// FieldDeclaration::watched_by.
  virtual void step_limits(const Scene& scene, StepLimits& limits) const;
  /// What it takes beside its fields, bytes, about: for the forecast of a run. It takes it no earlier than its passes
  /// run.
  [[nodiscard]] virtual double memory() const;
  /// What would be better otherwise, in this scene. `limits` are those on the step of all plugins.
  virtual void suggest(const Scene& scene, const StepLimits& limits, std::vector<Suggestion>& list) const;
};

}  // namespace mesogen
