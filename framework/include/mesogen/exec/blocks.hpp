#pragma once

#include <algorithm>

#include "mesogen/fields/field_view.hpp"

/// Before a loop over particles: none of its turns reads what another one writes. Without it a compiler would have to
/// compare all pointers first, and gives up if they are many.
#if defined(__GNUC__) && !defined(__clang__) && !defined(__CUDACC__)
#define MESOGEN_TURNS_ARE_INDEPENDENT _Pragma("GCC ivdep")
#else
#define MESOGEN_TURNS_ARE_INDEPENDENT
#endif

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
