#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesogen/fields/field_view.hpp"

namespace mesogen {

/// Where in storage a few chosen particles are. They are looked for only where one is no longer in its last place:
/// particles are rarely stored anew.
class Places {
 public:
  /// `ids`: of the chosen particles; `stored`: of all, ObserverContext::id. Place n is that of ids[n].
  const std::vector<Index>& find(const std::vector<std::int64_t>& ids, std::span<const std::int64_t> stored) {
    bool same = place_.size() == ids.size();
    for (std::size_t n = 0; same && n < ids.size(); ++n) same = stored[static_cast<std::size_t>(place_[n])] == ids[n];
    if (same) return place_;
    std::vector<Index> all(stored.size());
    for (std::size_t i = 0; i < stored.size(); ++i) all.at(static_cast<std::size_t>(stored[i])) = static_cast<Index>(i);
    place_.clear();
    for (const auto id : ids) place_.push_back(all.at(static_cast<std::size_t>(id)));
    return place_;
  }

 private:
  std::vector<Index> place_;
};

}  // namespace mesogen
