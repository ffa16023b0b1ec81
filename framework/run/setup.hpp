#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "case/arrangement.hpp"
#include "case/case.hpp"
#include "exec/backend.hpp"
#include "mesogen/export.hpp"
#include "mesogen/plugin/scene.hpp"
#include "mesogen/sph/smoothing_kernel.hpp"
#include "plugin/registry.hpp"
#include "prescribed/prescribed.hpp"
#include "ranks/ranks.hpp"
#include "schedule/catalogue.hpp"
#include "schedule/step_graph.hpp"
#include "solids/confined_boundary.hpp"

namespace mesogen {

/// A checked case with its plugins made and its step ordered: all that is fixed before a run starts.
struct MESOGEN_EXPORT Setup {
  struct InitialMember {
    std::string name;  ///< of the plugin and its section, "director"
    PluginPointer<Initial> plugin;
    InitialPlan plan;
  };
  struct PhysicsMember {
    std::string instance;  ///< "physics.flow"
    PluginPointer<Physics> plugin;
    PassList passes;
    std::string type;        ///< "wcsph"
    bool on_device = false;  ///< its passes run on the backend's device
  };
  struct ObserverMember {
    std::string instance;  ///< "flow"
    PluginPointer<Observer> plugin;
    ObserverPlan plan;
    ObserverTiming timing;
    std::vector<std::string> fields;  ///< what it reads of what the scene has
    std::string type;                 ///< "flow_statistics"
  };

  explicit Setup(Case checked) : source(std::move(checked)), catalogue(source.dimension()) {}

  Case source;
  const Backend* backend = &Backend::host();  ///< where it runs
  const Ranks* ranks = &Ranks::alone();       ///< that share the run
  std::string why_on_host;                    ///< where a device would have been taken, had it been possible
  PluginPointer<Kernel> kernel;
  std::unique_ptr<Boundary> boundary;
  ConfinedBoundary* confined = nullptr;  ///< the same, if there are solids
  std::vector<InitialMember> initial;
  std::vector<PhysicsMember> physics;
  std::vector<ObserverMember> observers;
  std::vector<Prescribed> prescribed;  ///< numbers of the physics that vary in space and time
  Arrangement arrangement;
  Scene scene;
  sph::SmoothingKernel smoothing;
  Catalogue catalogue;
  std::vector<std::string> output_fields;  ///< without position
  std::unique_ptr<StepGraph> graph;        ///< readers: the observers in order, then the output
  StepLimits limits;
  std::string resolved_text;
  /// Whose code computes, and for which instruction set each was built: bits depend on these.
  std::string instruction_sets;
};

/// What an initial condition of a setup sets.
InitialState initial_state(const Setup::InitialMember& member, const Setup& setup);

/// Largest eigenvalue of minus the Laplacian of a run on a lattice, 1/m2.
double largest_laplacian(const Setup& setup);

/// Asks a plugin for its limits on the step. Throws Error(plugin_refused) if one is not above 0.
void add_step_limits(const Setup::PhysicsMember& member, const Setup& setup, StepLimits& limits);

/// What a test of a plugin puts into a scene beside its case, so that one plugin can be run without those it works
/// with.
struct SetupAdditions {
  std::function<void(Scene& scene)> scene;    ///< what others would publish; before plugins prepare
  std::function<void(Setup& setup)> fields;   ///< after the plugins named their fields
  std::function<void(Setup& setup)> readers;  ///< after the observers were planned; before the step is ordered
};

/// Makes the plugins of a case, reads their parameters and orders the step. Throws an Error with all problems of the
/// case at once: bad_case, or plugin_refused if a plugin that it needs was refused.
MESOGEN_EXPORT std::unique_ptr<Setup> set_up(Case source, const PluginRegistry& registry, Problems& problems,
                                             const SetupAdditions& additions = {});

}  // namespace mesogen
