#include "run/refusals.hpp"

#include <algorithm>
#include <set>
#include <string>

#include "run/fewest_neighbours.hpp"

namespace mesogen {

void refuse_traces(const Setup& setup, Problems& problems) {
  const Case& source = setup.source;
  const auto flow = std::find_if(setup.physics.begin(), setup.physics.end(),
                                 [](const auto& member) { return member.passes.transport().fixed; });
  if (flow == setup.physics.end()) return;
  const std::string why = "in the Eulerian motion of '" + flow->instance + "' particles stay where they are, so ";
  for (std::size_t n = 0; n < setup.initial.size(); ++n)
    if (setup.initial[n].plan.moving_particles_needed())
      problems.add(source.initial[n].section.place(), source.initial[n].section.path(),
                   why + "what it sets would not move; remove it, or take motion = \"lagrangian\"");
  for (std::size_t n = 0; n < setup.observers.size(); ++n)
    if (setup.observers[n].plan.traces())
      problems.add(source.observers[n].section.place(), source.observers[n].section.path(),
                   why + "this observer would see nothing move; remove it, or take motion = \"lagrangian\"");
}

void refuse_few_neighbours(const Setup& setup, Problems& problems) {
  const Case& source = setup.source;
  const StepGraph& graph = *setup.graph;
  std::set<std::string> derived = graph.derived_for_integration();
  for (std::size_t n = 0; n <= setup.observers.size(); ++n)
    derived.insert(graph.derived_for_reader(n).begin(), graph.derived_for_reader(n).end());
  if (derived.empty() && !graph.sums_pairs()) return;
  const Transport& flow = graph.transport();
  const NeighbourNeeds needs{
      .quadratic = source.laplacian == "consistent" &&
                   (std::ranges::any_of(graph.staged(), [](const auto& terms) { return terms.diffusion.any(); }) ||
                    std::ranges::any_of(derived, [](const std::string& name) { return name.ends_with("_laplacian"); })),
      .moving = !flow.velocity.empty() && !flow.fixed};
  if (const std::string problem = neighbours_problem(source, setup.smoothing, needs); !problem.empty())
    problems.add(source.place("kernel.smoothing_length"), "kernel.smoothing_length", problem);
}

}  // namespace mesogen
