#pragma once

#include <cstdint>

#include "diagnostics/log.hpp"
#include "schedule/state.hpp"

namespace mesogen {

/// What ranks cost a run: how even their parts are, what they send, and how long they wait for each other.
class RankLog {
 public:
  /// The state must outlive it.
  explicit RankLog(const State& state) : state_(state) {}

  /// Before the first step.
  void begin();
  /// After so many steps, which took so long; nothing in a run on one process. All ranks call it.
  void tell(Log& log, std::int64_t steps, double seconds) const;

 private:
  const State& state_;
  Ranks::Traffic before_;
  std::int64_t for_ghosts_before_ = 0;
};

}  // namespace mesogen
