#pragma once

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <vector>

#include "mesogen/fields/field_view.hpp"

namespace mesogen::exec {

/// Shares [0, count) out among threads. Each thread has its own part, whose data its cache may still hold, and takes
/// this part piece by piece. A thread that is done takes pieces of the other threads. So no thread waits long for a
/// thread that is slowed, by another program or by a thread on the same core. Which thread takes which piece depends on
/// timing: use this class only for work whose results do not depend on it.
class WorkStealing {
 public:
  explicit WorkStealing(Index count)
      : piece_(std::max<Index>(1, count / (pieces_a_thread * omp_get_max_threads()))),
        parts_(static_cast<std::size_t>(omp_get_max_threads())) {
    const auto number = static_cast<std::int64_t>(parts_.size());
    for (std::int64_t n = 0; n < number; ++n) {
      Part& part = parts_[static_cast<std::size_t>(n)];
      part.next = static_cast<Index>(count * n / number);
      part.end = static_cast<Index>(count * (n + 1) / number);
    }
  }

  /// Calls work(i) until no i is left. Each thread of a team calls `take` once.
  template <class Work>
  void take(const Work& work) {
    const auto own = static_cast<std::size_t>(omp_get_thread_num());
    for (std::size_t n = 0; n < parts_.size(); ++n) {
      Part& part = parts_[(own + n) % parts_.size()];
      while (part.next.load(std::memory_order_relaxed) < part.end) {
        const Index begin = part.next.fetch_add(piece_, std::memory_order_relaxed);
        const Index end = std::min(part.end, begin + piece_);
        for (Index i = begin; i < end; ++i) work(i);
      }
    }
  }

 private:
  static constexpr Index pieces_a_thread = 64;

  struct alignas(64) Part {  // a cache line each
    std::atomic<Index> next{0};
    Index end = 0;
  };

  Index piece_;
  std::vector<Part> parts_;
};

}  // namespace mesogen::exec
