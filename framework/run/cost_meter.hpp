#pragma once

#include <chrono>
#include <cstdint>

#include "output/run_record.hpp"

namespace mesogen {

/// What a run takes, with the sessions before this one.
class CostMeter {
 public:
  /// Starts counting at a step. `before`: of the run until then.
  void start(std::int64_t step, const RunCost& before);
  /// Of the run until a step. A session counts once it has made one.
  [[nodiscard]] RunCost at(std::int64_t step) const;
  /// Wall time of this session, s.
  [[nodiscard]] double seconds() const;

 private:
  RunCost before_;
  std::int64_t first_step_ = 0;
  std::chrono::steady_clock::time_point begun_{};
  double cpu_begun_ = 0.0;
};

}  // namespace mesogen
