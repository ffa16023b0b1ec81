// The blocks of a particle reach from the first to the last within range, particle by particle, whatever lies behind.

#include "neighbours/neighbour_blocks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "sph/standard_passes.hpp"

namespace {

using namespace mesogen;

template <class Real, int Dimension>
struct Of {
  using Number = Real;
  static constexpr int Dim = Dimension;
};

/// `count` particles of a single row of cells, and behind them what no block may hold: as near to everybody as can be.
/// With `rows` = 3 the row is its own neighbour on either side too.
template <class Real, int Dim>
class OneCell {
 public:
  OneCell(Index count, unsigned seed, int rows = 1) : end_(count) {
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
    if (rows == 3) {
      grid_.wrapped[1] = true;
      grid_.reach[1] = 1;
    }
  }

  [[nodiscard]] const Neighbours<Real, Dim>& grid() const { return grid_; }

  /// `row`: how many rows up j is seen.
  [[nodiscard]] bool near(Index i, Index j, Real range, int row = 0) const {
    Real square(0);
    for (int d = 0; d < Dim; ++d) {
      const Real way = grid_.local[d][i] - Real(d == 1 ? row : 0) - grid_.local[d][j];
      square += way * way;
    }
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

// Rows share blocks only where a pack holds a block. In any case blocks hold, row by row, what lies between the first
// particle within range and the last one.
TYPED_TEST(NeighbourBlocksOf, HoldTwoRowsWhereOneLeavesRoom) {
  using Real = typename TypeParam::Number;
  constexpr int dimension = TypeParam::Dim;
  constexpr Index width = NeighbourBlock::width<Real>;
  constexpr double range = 0.7;
  int shared = 0;
  for (Index count = 1; count <= 3 * width + 1; ++count) {
    const OneCell<Real, dimension> cell(count, static_cast<unsigned>(count), 3);
    NeighbourBlocks blocks;
    blocks.find(cell.grid(), range);
    for (Index i = 0; i < count; ++i) {
      std::vector<std::pair<int, Index>> expected;
      for (int row = -1; row <= 1; ++row) {
        Index first = 0;
        while (first < count && !cell.near(i, first, Real(range), row)) ++first;
        Index last = count - 1;
        while (last >= first && !cell.near(i, last, Real(range), row)) --last;
        for (Index j = first; j <= last; ++j) expected.emplace_back(row, j);
      }
      std::vector<std::pair<int, Index>> found;
      for (auto n = blocks.begin[static_cast<std::size_t>(i)]; n < blocks.begin[static_cast<std::size_t>(i) + 1]; ++n) {
        const NeighbourBlock& block = blocks.block[static_cast<std::size_t>(n)];
        ASSERT_GT(block.split, 0);
        ASSERT_LE(block.split, block.lanes);
        ASSERT_LE(block.lanes, width);
        if (block.split < block.lanes) ++shared;
        for (int lane = 0; lane < block.lanes; ++lane)
          found.emplace_back(block.shift_at(lane, 1), block.particle(lane));
      }
      ASSERT_EQ(found, expected) << i << " of " << count;
    }
  }
  EXPECT_EQ(shared > 0, std::string(sph::instruction_set()) == "x86-64-v4");
}

}  // namespace
