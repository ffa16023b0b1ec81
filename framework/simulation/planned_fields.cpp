#include "simulation/planned_fields.hpp"

#include <set>

namespace mesogen {

std::vector<PlannedField> planned_fields(const Setup& setup) {
  std::set<std::string> used;
  const auto use = [&](const std::vector<std::string>& names) { used.insert(names.begin(), names.end()); };
  for (const Work& work : setup.graph->works()) {
    if (work.pruned()) continue;
    use(work.pass.own_reads);
    use(work.pass.neighbour_reads);
    use(work.pass.optional_reads);
    use(work.pass.write_list);
    use(work.pass.accumulate_list);
  }
  // Where all who add to a field are idle it stays zero.
  for (const auto& observer : setup.observers) use(observer.fields);
  use(setup.output_fields);
  // A flow that the case gives, and no plugin makes, is one too.
  const std::string& flow = setup.graph->transport().velocity;
  const std::string velocity = flow.empty() && setup.source.velocity.given ? "velocity" : flow;
  std::vector<PlannedField> planned;
  for (const auto& [name, entry] : setup.catalogue.all()) {
    const bool integrated = has_rate(entry.declaration.advance);
    if (integrated || setup.catalogue.outlasts_step(name) || used.contains(name))
      planned.push_back({name, setup.catalogue.components(name), integrated, setup.catalogue.kind(name, velocity)});
  }
  return planned;
}

std::vector<std::string> checkpointed_fields(const Setup& setup) {
  std::vector<std::string> names;
  for (const auto& [name, entry] : setup.catalogue.all()) {
    if (!setup.catalogue.outlasts_step(name)) continue;
    names.push_back(name);
    if (entry.declaration.advance == Advance::predicted) names.push_back(entry.declaration.rate);
  }
  return names;
}

}  // namespace mesogen
