#include "ranks/journey.hpp"

#include <numeric>

namespace mesogen {

Journey::Journey(const Ranks& ranks, std::span<const int> owner)
    : ranks_(ranks), left_(static_cast<std::size_t>(ranks.count()) + 1, 0), came_(left_) {
  std::vector<std::int64_t> to(static_cast<std::size_t>(ranks.count()), 0);
  for (std::size_t i = 0; i < owner.size(); ++i) {
    if (owner[i] == ranks.rank()) {
      staying_.push_back(i);
    } else {
      ++to[static_cast<std::size_t>(owner[i])];
    }
  }
  std::partial_sum(to.begin(), to.end(), left_.begin() + 1);
  leaving_.resize(left_.back());
  std::vector<std::size_t> next = left_;
  for (std::size_t i = 0; i < owner.size(); ++i)
    if (owner[i] != ranks.rank()) leaving_[next[static_cast<std::size_t>(owner[i])]++] = i;
  const std::vector<std::int64_t> from = ranks.swap(to);
  std::partial_sum(from.begin(), from.end(), came_.begin() + 1);
  anybody_ = any(ranks, !leaving_.empty());
}

}  // namespace mesogen
