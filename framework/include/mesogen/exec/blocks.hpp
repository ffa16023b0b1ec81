#pragma once

#include <algorithm>

#include "mesogen/particles/field_view.hpp"

namespace mesogen::exec {

/// Cuts [0, count) into blocks that threads share out. A loop that calculates goes block by block: compilers may round
/// differently in the vector loop and in the remainder behind it (where they contract to fused multiply-adds), and so
/// which is which must not depend on how many threads there are.
class Blocks {
 public:
  explicit Blocks(Index count) : count_(count) {}
  [[nodiscard]] Index number() const { return (count_ + size - 1) / size; }
  [[nodiscard]] Index begin(Index block) const { return block * size; }
  [[nodiscard]] Index end(Index block) const { return std::min<Index>(count_, (block + 1) * size); }

 private:
  // A multiple of all vector widths, or else every block had a remainder; small, so that few particles give every
  // thread something to do.
  static constexpr Index size = 64;
  Index count_;
};

}  // namespace mesogen::exec
