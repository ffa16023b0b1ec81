#include "run/planned_fields.hpp"

#include <set>

namespace mesogen {

namespace {

/// Of the flow plugin, or else of an initial condition; empty if there is none.
std::string velocity_of_fluid(const Setup& setup) {
  std::string velocity = setup.graph->transport().velocity;
  for (const auto& member : setup.initial)
    if (velocity.empty()) velocity = member.plan.velocity();
  return velocity;
}

}  // namespace

std::vector<PlannedField> planned_fields(const Setup& setup) {
  std::set<std::string> used;
  const auto use = [&](const std::vector<std::string>& names) { used.insert(names.begin(), names.end()); };
  for (const ScheduledPass& scheduled : setup.graph->passes()) {
    if (scheduled.pruned()) continue;
    use(scheduled.pass.own_reads);
    use(scheduled.pass.neighbour_reads);
    use(scheduled.pass.optional_reads);
    use(scheduled.pass.write_list);
    use(scheduled.pass.accumulate_list);
  }
  // Where all who add to a field are idle it stays zero.
  for (const auto& observer : setup.observers) use(observer.fields);
  use(setup.output_fields);
  const std::string velocity = velocity_of_fluid(setup);
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
