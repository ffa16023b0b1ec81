#pragma once

#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "mesogen/diagnostics/error.hpp"
#include "schedule/step_graph.hpp"

namespace mesogen::test {

/// Plugins made up by a test, and the graph of their passes.
class GraphFixture {
 public:
  /// The passes of an instance, to be filled in.
  PassList& plugin(const std::string& instance) {
    lists_.emplace_back();
    instances_.push_back(instance);
    return lists_.back();
  }
  /// A field that an initial condition sets.
  void initial(const std::string& owner, const std::string& field) {
    FieldDeclaration declaration;
    declaration.name = field;
    initial_.emplace_back(owner, declaration);
  }
  void reader(const std::string& name, const std::vector<std::string>& fields) { readers_.push_back({name, fields}); }

  [[nodiscard]] StepGraph graph() {
    std::vector<StepGraph::Member> members;
    for (std::size_t n = 0; n < instances_.size(); ++n) {
      for (const FieldDeclaration& field : lists_[n].fields()) catalogue_.add(field, instances_[n]);
      members.push_back({instances_[n], &lists_[n]});
    }
    for (const auto& [owner, field] : initial_) catalogue_.add_initial(field, owner);
    return {catalogue_, members, readers_};
  }
  /// What it says instead of making a graph.
  [[nodiscard]] std::string refusal(ExitCode code = ExitCode::bad_case) {
    try {
      (void)graph();
    } catch (const Error& error) {
      return error.code() == code ? error.what() : "another exit code";
    }
    return "no error";
  }

 private:
  std::deque<PassList> lists_;
  std::vector<std::string> instances_;
  std::vector<Reader> readers_;
  std::vector<std::pair<std::string, FieldDeclaration>> initial_;
  Catalogue catalogue_{2};
};

/// Titles of the passes of a phase in the order in which they run.
inline std::vector<std::string> titles(const StepGraph& graph, Phase phase = Phase::rates) {
  std::vector<std::string> all;
  for (const std::size_t n : graph.order(phase)) all.push_back(graph.passes()[n].title());
  return all;
}

}  // namespace mesogen::test
