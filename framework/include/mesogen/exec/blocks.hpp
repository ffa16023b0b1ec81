#pragma once

#include <algorithm>

#include "mesogen/fields/field_view.hpp"

namespace mesogen::exec {

/// Loops over fewer particles, with a few operations for each, run on one thread: with several, waiting takes longer.
inline constexpr Index parallel_from = 4096;

/// Cuts [0, count) into blocks, which threads share out. Loops that calculate go block by block: a compiler may round
/// differently in its vector loop and in the remainder loop behind it (where it contracts to fused multiply-adds).
/// Blocks make the choice between the two independent of the number of threads.
class Blocks {
 public:
  explicit Blocks(Index count) : count_(count) {}
  [[nodiscard]] Index number() const { return (count_ + size - 1) / size; }
  [[nodiscard]] Index begin(Index block) const { return block * size; }
  [[nodiscard]] Index end(Index block) const { return std::min<Index>(count_, (block + 1) * size); }

 private:
  // A multiple of all vector widths, so that only the last block has a remainder. Small, so that every thread has work
  // even with few particles.
  static constexpr Index size = 64;
  Index count_;
};

}  // namespace mesogen::exec
