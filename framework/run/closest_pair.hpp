#pragma once

#include <optional>

#include "mesogen/export.hpp"
#include "schedule/state.hpp"

namespace mesogen {

struct ClosestPair {
  Index a = -1;
  Index b = -1;
  double distance = 0.0;  ///< m
};

/// The two particles closest to each other where the neighbourhood last placed them, if they are closer than `within`
/// (m; shorter than the support). Of equally close ones, those stored first.
MESOGEN_EXPORT std::optional<ClosestPair> closest_pair(const State& state, double within);

}  // namespace mesogen
