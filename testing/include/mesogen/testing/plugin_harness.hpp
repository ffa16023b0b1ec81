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
#include "mesogen/sph/kernel_function.hpp"

namespace mesogen::testing {

/// The scene that a plugin is tested in: a square or cubic box of particles.
struct TestScene {
  int dimension = 0;                       ///< 0: the fewest in which the tested plugin can be used
  double length = 1.0;                     ///< edge of the box, m
  int across = 20;                         ///< particles along it
  std::string arrangement = "jittered";    ///< lattice, hexagonal, or jittered: the same each time
  std::string kernel = "quintic";          ///< h = 4/3 spacings
  std::string boundary = "periodic_wrap";  ///< name of the plugin
  Precision precision = Precision::double_precision;
  std::string device = "cpu";               ///< as run.device of a case
  double step = 0.0;                        ///< s; 0: as long as the plugins allow
  std::string more;                         ///< further sections of a case: "[physics.flow]\ntype = ..."
  std::map<std::string, double> constants;  ///< that other plugins would publish
};

/// Folders in which the tested plugins lie, separated by colons; mesogen_add_plugin defines it for its tests.
#ifndef MESOGEN_TESTED_PLUGINS
#define MESOGEN_TESTED_PLUGINS ""
#endif

/// A plugin library in a scene of its own, loaded and run as a run does it: by the real loader, case reader, scheduler
/// and integrator, so that it fails here with the words with which it would fail there.
///
///     PluginHarness drag(PluginKind::physics, "friction", "coefficient = 0.6");
///     drag.set("velocity", {3.0, -4.0}).set("density", {2.0});
///     drag.run("friction");
///     EXPECT_DOUBLE_EQ(drag.value("acceleration", 0), -0.6 / 2.0 * 3.0);
///
/// Fields that nobody in the scene makes are given: they start with seeded random numbers (scalars 0.5 to 1.5, other
/// components -0.5 to 0.5; fields that are advanced in time within 0.05 of 0), or with what `set` says. Nothing is
/// pruned: every field that somebody makes can be looked at, and its gradient and Laplacian if it is a state.
/// Particles are named by their ids. The scene is put together when something is first asked of it; what is wrong with
/// the plugin or its keys is thrown then, as mesogen::Error.
class MESOGEN_EXPORT PluginHarness {
 public:
  using Function = std::function<double(double x, double y)>;
  using Quantities = std::map<std::string, std::vector<double>, std::less<>>;

  /// `keys`: as in the plugin's section of a case, one a line.
  PluginHarness(PluginKind kind, std::string_view name, std::string_view keys = "", const TestScene& scene = {},
                std::string_view folders = MESOGEN_TESTED_PLUGINS);
  /// The scene of a complete case.
  explicit PluginHarness(std::string_view case_text, std::string_view folders = MESOGEN_TESTED_PLUGINS);
  PluginHarness(PluginHarness&&) noexcept;
  ~PluginHarness();

  /// Gives a field: each component the same everywhere, or a function of the position. How many components it has is
  /// told by the plugins that know it; of a field that none knows, by the values.
  PluginHarness& set(std::string_view field, std::initializer_list<double> components);
  PluginHarness& set(std::string_view field, std::initializer_list<Function> components);
  /// Puts a field that other plugins know into the scene, with seeded numbers: what the plugin reads if it is present.
  PluginHarness& give(std::string_view field);
  /// One component, by particle.
  PluginHarness& set_values(std::string_view field, int component, std::vector<double> values);
  /// Other random numbers for all fields that were not set.
  PluginHarness& seed(std::int64_t seed);
  /// What PassContext::step_size says when single passes run, s.
  PluginHarness& set_step_size(double seconds);

  /// One pass of the plugin by itself. What it adds to starts from what `set` gave it, or 0.
  void run(std::string_view pass);
  /// All passes of a phase, as in a step: each accumulator starts from 0.
  void run(Phase phase);
  /// The rates at the initial state, and the observer's start. `step`, `run_until` and `sample` do it themselves.
  void start();
  void step(int steps = 1);
  void run_until(double seconds);
  /// What the observer records now: exactly the quantities of its plan, each of whole rows.
  Quantities sample();
  /// Goes on where another harness of the same scene stands, by a checkpoint of that, as `mesogen resume` does.
  void resume_from(PluginHarness& other);
  /// Of that, what concerns the observer: start(), then what its save() gave in another scene, and its time, s.
  void restore(const std::map<std::string, std::vector<double>>& saved, double time);

  [[nodiscard]] std::vector<double> values(std::string_view field, int component = 0);
  [[nodiscard]] double value(std::string_view field, int component = 0, std::int64_t particle = 0);
  /// Coordinates in the box, m.
  [[nodiscard]] std::vector<double> position(int axis);
  /// Coordinates without jumps at the faces, m.
  [[nodiscard]] std::vector<double> path(int axis);
  /// Moves particles, each by (x, y), m.
  PluginHarness& move(const Function& x, const Function& y);
  /// The observer samples particles that are stored in another order; nothing else changes.
  PluginHarness& shuffle(std::int64_t seed);
  [[nodiscard]] double time();
  [[nodiscard]] std::int64_t particles();
  /// With the scales and constants of all plugins.
  [[nodiscard]] Scene scene();
  [[nodiscard]] sph::SmoothingKernel smoothing();
  /// Seconds by the text of each limit on the step.
  [[nodiscard]] std::map<std::string, double> step_limits();
  /// Every field that can be looked at.
  [[nodiscard]] std::vector<std::string> fields();
  [[nodiscard]] int components(std::string_view field);

  /// The tested plugin itself, until a field is set; throws if it is of another kind.
  [[nodiscard]] Kernel& kernel();
  [[nodiscard]] Boundary& boundary();
  [[nodiscard]] Initial& initial();
  [[nodiscard]] Physics& physics();
  [[nodiscard]] Observer& observer();
  /// What it declared.
  [[nodiscard]] const PassList& passes();
  [[nodiscard]] const InitialPlan& initial_plan();
  [[nodiscard]] const ObserverPlan& plan();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace mesogen::testing
