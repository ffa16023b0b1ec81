// The blocks of a particle reach from the first to the last within range, particle by particle, whatever lies behind.

#include "neighbours/neighbour_blocks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace {

using namespace mesogen;

template <class Real, int Dimension>
struct Of {
  using Number = Real;
  static constexpr int Dim = Dimension;
};

/// `count` particles of a single cell, and behind them what no block may hold: as near to everybody as can be.
template <class Real, int Dim>
class OneCell {
 public:
  OneCell(Index count, unsigned seed) : end_(count) {
    std::mt19937 random(seed);
    for (int d = 0; d < Dim; ++d) {
      for (Index i = 0; i < count; ++i) local_[d].push_back(std::generate_canonical<Real, 24>(random));
      local_[d].resize(static_cast<std::size_t>(count) + 16, Real(0.5));
      grid_.local[d] = local_[d].data();
      grid_.cells[d] = 1;
      grid_.width[d] = 1.0;
    }
    grid_.cell_begin = &begin_;
    grid_.cell_end = &end_;
    grid_.particle_count = count;
    grid_.tile = 1;
  }

  [[nodiscard]] const Neighbours<Real, Dim>& grid() const { return grid_; }

  [[nodiscard]] bool near(Index i, Index j, Real range) const {
    Real square(0);
    for (int d = 0; d < Dim; ++d)
      square += (grid_.local[d][i] - grid_.local[d][j]) * (grid_.local[d][i] - grid_.local[d][j]);
    return square <= range * range;
  }

 private:
  Index begin_ = 0;
  Index end_;
  std::vector<Real> local_[Dim];
  Neighbours<Real, Dim> grid_{};
};

template <class Case>
class NeighbourBlocksOf : public testing::Test {};
using Cases = testing::Types<Of<float, 2>, Of<double, 2>, Of<float, 3>, Of<double, 3>>;
TYPED_TEST_SUITE(NeighbourBlocksOf, Cases);

TYPED_TEST(NeighbourBlocksOf, ReachFromTheFirstToTheLastWithinRange) {
  using Real = typename TypeParam::Number;
  constexpr int dimension = TypeParam::Dim;
  constexpr Index width = NeighbourBlock::width<Real>;
  constexpr double range = 0.4;
  for (Index count = 1; count <= 3 * width + 1; ++count) {
    const OneCell<Real, dimension> cell(count, static_cast<unsigned>(count));
    NeighbourBlocks blocks;
    blocks.find(cell.grid(), range);
    ASSERT_EQ(blocks.begin.size(), static_cast<std::size_t>(count) + 1);
    for (Index i = 0; i < count; ++i) {
      Index first = 0;
      while (!cell.near(i, first, Real(range))) ++first;
      Index last = count - 1;
      while (!cell.near(i, last, Real(range))) --last;
      Index next = first;
      for (auto n = blocks.begin[static_cast<std::size_t>(i)]; n < blocks.begin[static_cast<std::size_t>(i) + 1]; ++n) {
        const NeighbourBlock& block = blocks.block[static_cast<std::size_t>(n)];
        ASSERT_EQ(block.first, next) << i << " of " << count;
        ASSERT_EQ(block.lanes, std::min(width, last + 1 - next)) << i << " of " << count;
        next += block.lanes;
      }
      ASSERT_EQ(next, last + 1) << i << " of " << count;
    }
  }
}

}  // namespace
