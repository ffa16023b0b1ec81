#include "domain/copy_rules.hpp"

#include <algorithm>

namespace mesogen {

const Extension* CopyRules::of(const Field& field, const Scene& scene, const Boundary& boundary,
                               const Neighbourhood& neighbourhood) {
  if (sorted_version_ != neighbourhood.sorted_version()) rules_.clear();
  sorted_version_ = neighbourhood.sorted_version();
  const auto [at, is_new] = rules_.try_emplace(field.name(), memory_);
  if (is_new) {
    const Copies& copies = neighbourhood.copies();
    std::vector<Extension> rules(copies.source.size() * static_cast<std::size_t>(field.components()));
    boundary.carry_over(scene, field.name(), field.components(), copies, rules);
    const bool the_same = std::all_of(rules.begin(), rules.end(),
                                      [](const Extension& rule) { return rule.factor == 1.0 && rule.summand == 0.0; });
    if (!the_same) at->second.assign(rules.begin(), rules.end());
  }
  return at->second.empty() ? nullptr : at->second.data();
}

}  // namespace mesogen
