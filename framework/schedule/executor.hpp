#pragma once

#include <string>
#include <vector>

#include "mesogen/export.hpp"
#include "schedule/derived_fields.hpp"
#include "schedule/step_graph.hpp"
#include "schedule/world.hpp"

namespace mesogen {

/// Runs the passes of a step: derived fields and boundary copies are brought up to date before a pass reads them,
/// accumulators are zeroed before the first pass adds to them.
class MESOGEN_EXPORT Executor {
 public:
  Executor(World& world, StepGraph& graph, DerivedFields& derived);

  /// All passes of a phase that the integration needs, or a reader that is due at the end of this step.
  void run(Phase phase, const std::vector<bool>& reader_due);
  /// One pass by itself, a member of the graph's works; what it adds to keeps its value before.
  void run_alone(Work& work);
  /// Brings what a reader reads up to date, as far as that follows from the state alone.
  void prepare(const std::vector<std::string>& fields);

 private:
  void run(Work& work);
  void prepare(const std::string& field);

  World& world_;
  StepGraph& graph_;
  DerivedFields& derived_;
};

}  // namespace mesogen
