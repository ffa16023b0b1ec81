#pragma once

#include <cstdint>
#include <limits>
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

  /// The first time after `time`, s, on which a step must end; infinite if there is none. In a run that ends at `end`,
  /// a time that is the end but for the digits of the interval (3.333333 for a third of 10) is the end: no tiny step
  /// follows it.
  [[nodiscard]] double next(double time, double end = std::numeric_limits<double>::infinity()) const;
  /// Does it happen at the end of the step from `from` to `to` (s), the one that makes `steps` of them?
  [[nodiscard]] bool due(double from, double to, std::int64_t steps) const;
  /// Is this time, s, one of them, whenever a run ends? Of those that go by simulated time.
  [[nodiscard]] bool has(double time) const;
  /// How many of the times after the start have come by `time`, s; of those that go by simulated time.
  [[nodiscard]] double count(double time) const;
  /// How often it happens in a run to `end`, s, of so many steps, beside the start: at its times, and at the end.
  [[nodiscard]] double count_in_run(double end, double steps) const;
};

}  // namespace mesogen
