#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mesogen/export.hpp"
#include "output/checkpoint.hpp"
#include "schedule/derived_fields.hpp"
#include "schedule/executor.hpp"
#include "schedule/world.hpp"
#include "simulation/guard.hpp"
#include "simulation/setup.hpp"
#include "time/integrator.hpp"
#include "time/step_control.hpp"

namespace mesogen {

/// The state of a run and how it goes on by one step.
class MESOGEN_EXPORT Stepper {
 public:
  /// At the initial conditions of the setup, which must outlive it.
  explicit Stepper(Setup& setup);

  /// Evaluates the rates at the initial state: the acceleration that the first step starts with.
  void start();
  /// The next step, no longer than to `end`.
  [[nodiscard]] StepControl::Choice next_step(double end) const;
  /// One step. `reader_due` tells which readers will read at its end. Throws Error(run_failed) if the run broke down.
  /// `arrival`: the time after it, where time + step_size would be that but for rounding.
  void advance(double step_size, const std::vector<bool>& reader_due, std::optional<double> arrival = {});

  [[nodiscard]] World& world() { return world_; }
  [[nodiscard]] Executor& executor() { return executor_; }
  /// Largest speed after the last step, m/s.
  [[nodiscard]] double fastest() const { return motion_.fastest; }
  [[nodiscard]] const StepControl& control() const { return control_; }
  [[nodiscard]] const Setup& setup() const { return setup_; }

  void save(Checkpoint& checkpoint);
  void restore(const Checkpoint& checkpoint);

  /// Where the time of steps went, piece by piece.
  [[nodiscard]] std::vector<Counter> shares() const;

 private:
  void add_fields();
  void set_initial_fields();
  void keep_order();

  Setup& setup_;
  World world_;
  std::unique_ptr<DerivedFields> derived_;
  Executor executor_;
  Integrator integrator_;
  StepControl control_;
  Guard guard_;
  Motion motion_;
  Counter whole_{"framework: step"};
  Counter integration_{"framework: integration"};
  Counter guarding_{"framework: guard"};
};

}  // namespace mesogen
