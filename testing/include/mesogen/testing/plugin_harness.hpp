#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/descriptor.hpp"
#include "mesogen/plugin/initial.hpp"
#include "mesogen/plugin/kernel.hpp"
#include "mesogen/plugin/observer.hpp"
#include "mesogen/plugin/passes.hpp"
#include "mesogen/plugin/physics.hpp"
#include "mesogen/plugin/scene.hpp"
#include "mesogen/plugin/shape.hpp"
#include "mesogen/sph/smoothing_kernel.hpp"

namespace mesogen::testing {

/// The scene in which a plugin is tested: a square or cubic box of particles.
struct TestScene {
  int dimension = 0;                       ///< 0: the fewest in which the tested plugin can be used
  double length = 1.0;                     ///< edge of the box, m
  int across = 20;                         ///< number of particles along the edge
  std::string arrangement = "jittered";    ///< lattice, hexagonal or jittered (always the same jitter)
  std::string kernel = "quintic";          ///< name of the plugin; h = 4/3 spacings
  std::string boundary = "periodic_wrap";  ///< name of the plugin
  Precision precision = Precision::double_precision;
  std::string device = "cpu";               ///< as run.device of a case
  double step = 0.0;                        ///< step size, s; 0: the largest that the plugins allow
  std::string more;                         ///< more sections of a case: "[physics.flow]\ntype = ..."
  std::map<std::string, double> constants;  ///< constants that other plugins would publish
};

/// Folders of the tested plugins, separated by colons; mesogen_add_plugin defines it for its tests.
#ifndef MESOGEN_TESTED_PLUGINS
#define MESOGEN_TESTED_PLUGINS ""
#endif

/// A plugin library in a scene of its own, loaded and run as in a real run: by the real loader, case reader, scheduler
/// and integrator. A plugin therefore fails here with the same messages as in a run.
///
///     PluginHarness drag(PluginKind::physics, "friction", "coefficient = 0.6");
///     drag.set("velocity", {3.0, -4.0}).set("density", {2.0});
///     drag.run("friction");
///     EXPECT_DOUBLE_EQ(drag.value("acceleration", 0), -0.6 / 2.0 * 3.0);
///
/// The harness gives the fields that no plugin of the scene makes. They start with the values of `set`, or with seeded
/// random numbers (scalars 0.5 to 1.5, other components -0.5 to 0.5; fields that are advanced in time within 0.05 of
/// 0). No pass is left out: every field that a plugin makes can be read, and also its gradient and Laplacian if it is a
/// state. Particles are named by their ids. The harness builds the scene at the first call that needs it, and throws
/// mesogen::Error then if the plugin or its keys are wrong.
class MESOGEN_EXPORT PluginHarness {
 public:
  using Function = std::function<double(double x, double y)>;
  using Quantities = std::map<std::string, std::vector<double>, std::less<>>;

  /// `keys`: as in the plugin's section of a case, one per line.
  PluginHarness(PluginKind kind, std::string_view name, std::string_view keys = "", const TestScene& scene = {},
                std::string_view folders = MESOGEN_TESTED_PLUGINS);
  /// Uses the scene of a complete case.
  explicit PluginHarness(std::string_view case_text, std::string_view folders = MESOGEN_TESTED_PLUGINS);
  PluginHarness(PluginHarness&&) noexcept;
  ~PluginHarness();

  /// Gives a field: for each component one value for all particles, or a function of the position. The plugins that
  /// know the field define its number of components; if no plugin knows it, the values define it.
  PluginHarness& set(std::string_view field, std::initializer_list<double> components);
  PluginHarness& set(std::string_view field, std::initializer_list<Function> components);
  /// Adds a field that other plugins know, with seeded random numbers: for what the plugin reads if present.
  PluginHarness& give(std::string_view field);
  /// Gives one component, one value per particle.
  PluginHarness& set_values(std::string_view field, int component, std::vector<double> values);
  /// Uses other random numbers for all fields that were not set.
  PluginHarness& seed(std::int64_t seed);
  /// Sets what PassContext::step_size returns when single passes run, s.
  PluginHarness& set_step_size(double seconds);

  /// Runs one pass of the plugin alone. A field to which it adds starts from what `set` gave, or from 0.
  void run(std::string_view pass);
  /// Runs all passes of a phase, as in a step: each field that passes add to starts from 0.
  void run(Phase phase);
  /// Computes the initial rates, and starts the observer. `step`, `run_until` and `sample` call it themselves.
  void start();
  void step(int steps = 1);
  void run_until(double seconds);
  /// Returns what the observer records now: exactly the quantities of its plan, each with complete rows.
  Quantities sample();
  /// Continues from the state of another harness of the same scene, by its checkpoint, as `mesogen resume` does.
  void resume_from(PluginHarness& other);
  /// Restores only the observer: start(), then what its save() returned in another scene, and that one's time, s.
  void restore(const std::map<std::string, std::vector<double>>& saved, double time);

  [[nodiscard]] std::vector<double> values(std::string_view field, int component = 0);
  [[nodiscard]] double value(std::string_view field, int component = 0, std::int64_t particle = 0);
  /// Coordinates in the box, m.
  [[nodiscard]] std::vector<double> position(int axis);
  /// Coordinates without jumps at the faces, m.
  [[nodiscard]] std::vector<double> path(int axis);
  /// Moves each particle by (x, y), m.
  PluginHarness& move(const Function& x, const Function& y);
  /// Stores the particles in another order for the observer's samples; nothing else changes.
  PluginHarness& shuffle(std::int64_t seed);
  [[nodiscard]] double time();
  [[nodiscard]] std::int64_t particles();
  /// The scene, with the scales and constants of all plugins.
  [[nodiscard]] Scene scene();
  [[nodiscard]] sph::SmoothingKernel smoothing();
  /// Limits on the step, s, by their texts.
  [[nodiscard]] std::map<std::string, double> step_limits();
  /// Every field that can be read.
  [[nodiscard]] std::vector<std::string> fields();
  [[nodiscard]] int components(std::string_view field);

  /// The tested plugin itself, valid until a field is set. Throws if it is of another kind.
  [[nodiscard]] Kernel& kernel();
  [[nodiscard]] Boundary& boundary();
  [[nodiscard]] Shape& shape();
  [[nodiscard]] Initial& initial();
  [[nodiscard]] Physics& physics();
  [[nodiscard]] Observer& observer();
  /// What the tested plugin declared.
  [[nodiscard]] const PassList& passes();
  [[nodiscard]] const InitialPlan& initial_plan();
  [[nodiscard]] const ObserverPlan& plan();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace mesogen::testing
