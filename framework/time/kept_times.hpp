#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "mesogen/export.hpp"
#include "time/timing.hpp"

namespace mesogen {

/// The simulated times at which a checkpoint is kept for good. Without memory: a resumed run keeps the same.
class MESOGEN_EXPORT KeptTimes {
 public:
  /// s; `every` adds its multiples.
  KeptTimes(std::vector<double> times, std::optional<double> every);

  /// The first after `time`, s, in a run to `end`; infinite if there is none. See Timing::next.
  [[nodiscard]] double next(double time, double end = std::numeric_limits<double>::infinity()) const;
  /// Does the step from `from` to `to` (s) reach one?
  [[nodiscard]] bool due(double from, double to) const;
  /// Is this time, s, one of them?
  [[nodiscard]] bool has(double time) const;
  /// How many there are in a run to `end`, s.
  [[nodiscard]] double count(double end) const;

 private:
  std::vector<double> times_;  // ascending
  Timing every_;
};

}  // namespace mesogen
