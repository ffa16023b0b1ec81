#pragma once

#include <cstdint>
#include <optional>

#include "mesogen/export.hpp"

namespace mesogen {

/// A time without the rounding of the sums that led to it: 3 x 0.1 s and 0.3 s are the same time. Keeps 14 significant
/// digits.
MESOGEN_EXPORT double rounded_time(double time);

/// When something happens that goes by simulated time or by steps. Without memory: a resumed run does the same.
struct MESOGEN_EXPORT Timing {
  std::optional<double> interval;     ///< s; at 0, interval, 2 interval, ...
  std::optional<std::int64_t> every;  ///< steps

  /// The first time after `time`, s, on which a step must end; infinite if there is none.
  [[nodiscard]] double next(double time) const;
  /// Does it happen at the end of the step from `from` to `to` (s), the one that makes `steps` of them?
  [[nodiscard]] bool due(double from, double to, std::int64_t steps) const;
};

}  // namespace mesogen
