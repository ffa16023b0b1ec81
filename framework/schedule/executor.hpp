#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "mesogen/export.hpp"
#include "schedule/derived_fields.hpp"
#include "schedule/state.hpp"
#include "schedule/step_graph.hpp"

namespace mesogen {

/// Runs the passes of a step: derived fields and boundary copies are brought up to date before a pass reads them,
/// accumulators are zeroed before the first pass adds to them.
class MESOGEN_EXPORT Executor {
 public:
  Executor(State& state, StepGraph& graph, DerivedFields& derived);

  /// All passes of a phase that the integration needs, or a reader that is due at the end of this step.
  /// `advance_velocity` is called after the passes of StepGraph::before_velocity, if there are such.
  void run(Phase phase, const std::vector<bool>& reader_due, const std::function<void()>& advance_velocity = {});
  /// One pass by itself, one of the graph's passes; what it adds to keeps its value before.
  void run_alone(ScheduledPass& scheduled);
  /// Brings what a reader reads up to date, as far as that follows from the state alone: derived fields, and what
  /// passes of Phase::observe make.
  void prepare(const std::vector<std::string>& fields);

 private:
  /// A pass of Phase::observe, and as of when what it made stands.
  struct Observed {
    ScheduledPass* scheduled;
    std::uint64_t positions = 0;
    std::map<std::string, std::uint64_t> versions;  // of what it reads and writes
  };

  /// What is done for readers leaves no trace in the integration.
  enum class Purpose { integration, reading };

  void run(ScheduledPass& scheduled);
  void settle(Purpose purpose);
  void prepare(const std::string& field, Purpose purpose);
  void prepare_for_reader(const std::string& field);
  void observe(Observed& observed);

  State& state_;
  StepGraph& graph_;
  DerivedFields& derived_;
  std::vector<Observed> observed_;
};

}  // namespace mesogen
