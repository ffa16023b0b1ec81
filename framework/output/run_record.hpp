#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

/// What a run knows of its own past. Checkpoints carry it, so that a resumed run tells of all of itself.
namespace mesogen {

/// What a run took, over all its sessions. Steps that were computed again after a kill count once.
struct RunCost {
  std::int64_t steps = 0;
  std::int64_t sessions = 0;     ///< processes that computed some of them: 1 for a run without a break
  double wall_seconds = 0.0;     ///< of stepping with its output, without start-up
  double cpu_seconds = 0.0;      ///< the same, of all threads
  int threads = 0;               ///< of the last session
  std::int64_t peak_memory = 0;  ///< resident, bytes, of the largest session; 0 where the system does not tell

  bool operator==(const RunCost&) const = default;
};

/// The checkpoint that a branch started from.
struct BranchOrigin {
  std::string folder;      ///< of the other run
  std::string checkpoint;  ///< its file there
  double time = 0.0;       ///< s
  std::int64_t step = 0;
  std::vector<std::string> changes;  ///< "physics.activity.activity=-0.05"

  bool operator==(const BranchOrigin&) const = default;
};

/// Who recorded the last state of a run only because the run ended there. A run that is extended forgets these records.
struct EndRecords {
  std::set<std::string> observers;
  bool frame = false;

  bool operator==(const EndRecords&) const = default;
};

}  // namespace mesogen
