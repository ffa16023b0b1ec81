#pragma once

#include <cstdint>
#include <vector>

#include "mesogen/export.hpp"
#include "time/kept_times.hpp"
#include "time/timing.hpp"

namespace mesogen {

/// Where a step ended.
struct Arrival {
  double time = 0.0;       ///< s
  double step_size = 0.0;  ///< of the step that led there, s; 0 at the start

  /// Whatever is asked for up to this time, s, happens here: no step leads from one time asked for to another a
  /// millionth of a step later.
  [[nodiscard]] double reaches() const { return time + 1e-6 * step_size; }
};

/// A way, s, cut into equal steps, as few as may be.
struct EqualSteps {
  double seconds;  ///< of each
  double count;
};
/// `longest`: what a step may last, s. Steps that lead there as they are stay so to the last bit: then the marks
/// between them do not matter.
MESOGEN_EXPORT EqualSteps equal_steps(double way, double longest);

/// The times on which steps of a run end, since a sample, a frame or a checkpoint is asked for: the marks. Without
/// memory: a resumed run has the same.
class MESOGEN_EXPORT Marks {
 public:
  Marks(std::vector<Timing> readers, KeptTimes kept);

  /// The next mark, s, in a run to `end`, or the end itself, where no mark comes before. `longest`: see equal_steps().
  [[nodiscard]] double next(const Arrival& now, double end, double longest) const;
  /// Which readers read at the end of the step between these two, the one that makes `steps` of them?
  [[nodiscard]] std::vector<bool> due(const Arrival& from, const Arrival& to, std::int64_t steps) const;
  /// Is a checkpoint kept for good at the end of that step?
  [[nodiscard]] bool keeps(const Arrival& from, const Arrival& to) const;
  /// Is this time, s, a mark, wherever the run ends?
  [[nodiscard]] bool has(double time) const;

  [[nodiscard]] const std::vector<Timing>& readers() const { return readers_; }
  [[nodiscard]] const KeptTimes& kept() const { return kept_; }

 private:
  std::vector<Timing> readers_;
  KeptTimes kept_;
};

}  // namespace mesogen
