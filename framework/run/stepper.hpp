#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mesogen/export.hpp"
#include "output/checkpoint.hpp"
#include "run/guard.hpp"
#include "run/kept_momentum.hpp"
#include "run/setup.hpp"
#include "run/watches.hpp"
#include "schedule/derived_fields.hpp"
#include "schedule/executor.hpp"
#include "schedule/state.hpp"
#include "time/integrator.hpp"
#include "time/marks.hpp"
#include "time/step_control.hpp"

namespace mesogen {

/// How the state of a run goes on by one step.
class MESOGEN_EXPORT Stepper {
 public:
  /// At the initial conditions of the setup, which must outlive it.
  explicit Stepper(Setup& setup);

  /// Evaluates the rates at the initial state: the acceleration that the first step starts with.
  void start();
  struct Step {
    double seconds;
    double arrival;     ///< the time at its end, s
    std::string limit;  ///< what binds
  };
  /// The next step on the way to `mark`, a time after now on which a step is to end: the way is cut into equal steps,
  /// as few as may be. So steps are shortened by little, and none is tiny.
  [[nodiscard]] Step next_step(double mark) const;
  /// The next step on the way to the next of these marks in a run to `end`, s.
  [[nodiscard]] Step next_step(const Marks& marks, double end) const;
  /// One step. `reader_due` tells which readers will read at its end. Throws Error(run_failed) if the run broke down.
  void advance(const Step& step, const std::vector<bool>& reader_due);

  [[nodiscard]] State& state() { return *state_; }
  [[nodiscard]] Executor& executor() { return executor_; }
  /// What plugins changed of themselves after the last step, for the log.
  [[nodiscard]] const std::vector<std::string>& changes() const { return changes_; }
  /// Where the last step ended.
  [[nodiscard]] Arrival arrival() const { return {state_->time, state_->step_size}; }
  /// What the last step found.
  [[nodiscard]] const Motion& motion() const { return motion_; }
  [[nodiscard]] const StepControl& control() const { return control_; }
  [[nodiscard]] const Setup& setup() const { return setup_; }

  void save(Checkpoint& checkpoint);
  void restore(const Checkpoint& checkpoint);

  /// Where the time of steps went, piece by piece.
  [[nodiscard]] std::vector<Counter> shares() const;

 private:
  void keep_order();
  void ask_limits();
  [[nodiscard]] StepControl::Choice longest_step() const;
  [[nodiscard]] double arrival_after(double step_size) const;

  Setup& setup_;
  std::unique_ptr<State> state_;
  PrescribedFields prescribed_;
  DerivedFields derived_;
  Executor executor_;
  Stages stages_;
  Integrator integrator_;
  StepControl control_;
  Guard guard_;
  Watches watches_;
  KeptMomentum momentum_;
  std::vector<std::string> changes_;
  Motion motion_;
  Counter whole_{"framework: step"};
  Counter integration_{"framework: integration"};
  Counter guarding_{"framework: guard"};
};

}  // namespace mesogen
