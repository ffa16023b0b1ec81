// In which order the passes of a phase run.

#include <algorithm>

#include "mesogen/diagnostics/error.hpp"
#include "schedule/derived_name.hpp"
#include "schedule/step_graph.hpp"

namespace mesogen {

namespace {

bool contains(const std::vector<std::string>& list, const std::string& what) {
  return std::ranges::find(list, what) != list.end();
}

// The field whose value a derived field follows; itself for a plain one. Empty for what depends on positions alone.
std::string root(const Catalogue& catalogue, const std::string& field) {
  if (catalogue.find(field) != nullptr) return field;
  const DerivedName derived = derived_name(field);
  return derived.source.empty() ? std::string() : root(catalogue, derived.source);
}

}  // namespace

void StepGraph::order_phase(Phase phase) {
  std::vector<std::size_t> members;
  for (std::size_t n = 0; n < passes_.size(); ++n)
    if (passes_[n].pass.phase == phase && !passes_[n].pruned()) members.push_back(n);

  // before[a] holds what must run before a, and through which field.
  Before before;
  for (const std::size_t a : members) {
    for (const std::size_t b : members) {
      if (a == b) continue;
      for (const std::string& field : passes_[b].pass.write_list)
        if (contains(passes_[a].pass.accumulate_list, field)) before[a].emplace(b, field);
      for (const std::string& field : passes_[b].pass.accumulate_list)
        if (b < a && contains(passes_[a].pass.accumulate_list, field)) before[a].emplace(b, field);
      for (const std::string& wanted : sources(passes_[a])) {
        const std::string field = root(catalogue_, wanted);
        if (!catalogue_.is_state(field) && makes(passes_[b], field)) before[a].emplace(b, field);
      }
    }
  }
  auto& order = order_[static_cast<std::size_t>(phase)];
  std::set<std::size_t> done;
  while (order.size() < members.size()) {
    const auto ready = std::find_if(members.begin(), members.end(), [&](std::size_t a) {
      return !done.contains(a) && std::all_of(before[a].begin(), before[a].end(),
                                              [&](const auto& edge) { return done.contains(edge.first); });
    });
    if (ready == members.end()) {
      // Follow unmet needs until one comes up again: that is the cycle.
      std::size_t at = *std::find_if(members.begin(), members.end(), [&](std::size_t a) { return !done.contains(a); });
      std::vector<std::size_t> path;
      while (std::find(path.begin(), path.end(), at) == path.end()) {
        path.push_back(at);
        at = std::find_if(before[at].begin(), before[at].end(), [&](const auto& edge) {
               return !done.contains(edge.first);
             })->first;
      }
      path.erase(path.begin(), std::find(path.begin(), path.end(), at));
      std::string text = "these passes wait for each other:";
      for (std::size_t n = 0; n < path.size(); ++n)
        text += "\n  '" + passes_[path[n]].title() + "' needs '" + before[path[n]][path[(n + 1) % path.size()]] +
                "' of '" + passes_[path[(n + 1) % path.size()]].title() + "'";
      throw Error(ExitCode::bad_case, text + "\nRemove one of the plugins from the case");
    }
    done.insert(*ready);
    order.push_back(*ready);
  }
  if (phase == Phase::rates && stages_velocity()) find_before_velocity(members, before);
}

// Who makes what the stages of the velocity need, and all that these need.
void StepGraph::find_before_velocity(const std::vector<std::size_t>& members, const Before& before) {
  std::vector<std::size_t> open;
  for (const LinearTerms& terms : staged_)
    if (terms.field == transport_.velocity)
      for (const std::size_t n : members)
        if (makes(passes_[n], terms.rate) || makes(passes_[n], terms.divisor)) open.push_back(n);
  while (!open.empty()) {
    const std::size_t n = open.back();
    open.pop_back();
    if (!before_velocity_.insert(n).second) continue;
    if (const auto at = before.find(n); at != before.end())
      for (const auto& [needed, field] : at->second) open.push_back(needed);
  }
}

}  // namespace mesogen
