#include "ghosts/rule_table.hpp"

#include <algorithm>

namespace mesogen {

namespace {

/// Does test(rule, row, column) hold for all entries of all matrices?
template <class Test>
bool all_entries(const std::vector<AffineRule>& rules, const Test& test) {
  return std::ranges::all_of(rules, [&](const AffineRule& rule) {
    for (int r = 0; r < rule.components(); ++r)
      for (int c = 0; c < rule.components(); ++c)
        if (!test(rule, r, c)) return false;
    return true;
  });
}

}  // namespace

RuleTable::RuleTable(const std::vector<AffineRule>& rules, exec::DeviceMemory* memory) : numbers_(memory) {
  if (rules.empty()) return;
  components_ = rules.front().components();
  const bool same = all_entries(rules, [](const AffineRule& rule, int r, int c) {
    return rule.matrix(r, c) == (r == c ? 1.0 : 0.0) && rule.summand(r) == 0.0;
  });
  if (same) return;
  diagonal_ =
      all_entries(rules, [](const AffineRule& rule, int r, int c) { return r == c || rule.matrix(r, c) == 0.0; });
  std::vector<double> numbers;
  numbers.reserve(rules.size() * static_cast<std::size_t>(RuleView::size(components_, diagonal_)));
  for (const AffineRule& rule : rules) {
    for (int r = 0; r < components_; ++r)
      for (int c = 0; c < components_; ++c)
        if (r == c || !diagonal_) numbers.push_back(rule.matrix(r, c));
    for (int c = 0; c < components_; ++c) numbers.push_back(rule.summand(c));
  }
  numbers_.assign(numbers);
}

}  // namespace mesogen
