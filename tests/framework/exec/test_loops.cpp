// The framework's own loops, as the host runs them; a device is compared with the host by tests/command/test_device.py
// and tests/device.

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "exec/reductions.hpp"
#include "ghosts/ghost_loops.hpp"
#include "ghosts/rule_table.hpp"
#include "neighbours/cell_grid.hpp"
#include "neighbours/cell_loops.hpp"
#include "particles/field_loops.hpp"
#include "particles/storage_loops.hpp"

namespace {

using namespace mesogen;

double found(exec::Reduction reduction) {
  Backend::host().wait();
  return Backend::host().found(reduction);
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

class Wrapped final : public Boundary {
 public:
  [[nodiscard]] Continuation continuation(int) const override { return Continuation::wrapped; }
};

// A step of particles on a lattice took half as long again before; a test cannot see that, but its cause.
TEST(Loops, SubnormalNumbersAreZeroWithinALoopAndAgainThemselvesBehindIt) {
  const int usual = omp_get_max_threads();
  volatile float small = 1e-30F;
  std::vector<float> products(1000, 1.0F);
  for (const int threads : {1, 2}) {
    omp_set_num_threads(threads);
    exec::for_each({}, 1000, [&](Index i) { products[static_cast<std::size_t>(i)] = small * 1e-10F; });
    EXPECT_EQ(std::count(products.begin(), products.end(), 0.0F), 1000) << threads << " threads";
    exec::for_each({}, 1000, [&](Index i) { products[static_cast<std::size_t>(i)] = small; });
    EXPECT_EQ(std::count(products.begin(), products.end(), 1e-30F), 1000) << threads << " threads";
  }
  omp_set_num_threads(usual);
  EXPECT_GT(small * 1e-10F, 0.0F);
}

TEST(Loops, WhatIsNotANumberIsInfinitelyLarge) {
  const auto& loops = Backend::host().fields<double>();
  const auto largest = [&](const std::vector<double>& x) {
    return found(loops.largest_square({x.data(), 300}, 1, 300));
  };
  const auto outside = [&](const std::vector<double>& x) {
    return found(loops.is_outside({x.data(), 300}, 1, 300, 0.0, 10.0));
  };
  for (const double bad : {nan, HUGE_VAL, -HUGE_VAL, 1e200}) {
    std::vector<double> values(300, 1.0);
    for (const std::size_t place : {0U, 150U, 299U}) {
      auto some = values;
      some[place] = bad;
      EXPECT_EQ(largest(some), HUGE_VAL) << bad;
      EXPECT_GT(outside(some), 0.0) << bad;
    }
    EXPECT_EQ(largest(values), 1.0);
    EXPECT_EQ(outside(values), 0.0);
  }
}

TEST(Loops, BoundsOfAVectorAreThoseOfItsLength) {
  const std::vector<float> values{0.6F, 3.0F, 0.8F, 4.0F};  // of lengths 1 and 5
  const auto outside = [&](double lowest, double highest) {
    return found(Backend::host().fields<float>().is_outside({values.data(), 2}, 2, 2, lowest, highest)) > 0.0;
  };
  EXPECT_FALSE(outside(0.9, 5.1));
  EXPECT_TRUE(outside(0.9, 4.9));
  EXPECT_TRUE(outside(1.1, 5.1));
}

TEST(Loops, GhostsGoByTheRulesOfTheirImages) {
  std::vector<double> values{1.0, 2.0, 0.0, 0.0, 10.0, 20.0, 0.0, 0.0};  // 2 particles, 2 ghosts, 2 components
  const std::vector<Index> source{1, 0};
  const std::vector<std::uint8_t> image{0, 1};
  const FieldView<double> field{values.data(), 4};
  const GhostView ghosts{2, 2, 2, source.data(), image.data(), {}, {}, {}};
  Backend::host().ghosts().refresh(ghosts, {}, field, 2);
  EXPECT_EQ(values, (std::vector<double>{1.0, 2.0, 2.0, 1.0, 10.0, 20.0, 20.0, 10.0}));
  const FieldKind kind{Rank::vector, FieldRole::velocity, 2};
  AffineRule first(kind);
  first.summand(0) = 0.5;
  const RuleTable diagonal({first, AffineRule::held_at(kind, std::array{0.0, 1.0})}, nullptr);
  EXPECT_TRUE(diagonal.view(exec::Side::host).diagonal);
  Backend::host().ghosts().refresh(ghosts, diagonal.view(exec::Side::host), field, 2);
  EXPECT_EQ(values, (std::vector<double>{1.0, 2.0, 2.5, -1.0, 10.0, 20.0, 20.0, -8.0}));
  // Along the diagonal the mirror image exchanges x and y, and their signs.
  const AffineRule mirror = AffineRule::reflected(kind, {std::sqrt(0.5), std::sqrt(0.5), 0.0});
  const RuleTable mixing({mirror, first.after(mirror)}, nullptr);
  EXPECT_FALSE(mixing.view(exec::Side::host).diagonal);
  Backend::host().ghosts().refresh(ghosts, mixing.view(exec::Side::host), field, 2);
  EXPECT_NEAR(values[2], -20.0, 1e-14);
  EXPECT_NEAR(values[6], -2.0, 1e-14);
  EXPECT_NEAR(values[3], -9.5, 1e-14);
  EXPECT_NEAR(values[7], -1.0, 1e-14);
}

TEST(Loops, RulesThatLeaveAllTheSameTakeNoRoom) {
  const FieldKind kind{Rank::matrix, FieldRole::derived, 2};
  const RuleTable same({AffineRule(kind), AffineRule(kind)}, nullptr);
  EXPECT_FALSE(same.view(exec::Side::host));
}

TEST(CellLoops, RunningSums) {
  for (const Index count : {0, 1, 5, 4096, 10000}) {
    std::vector<Index> values;
    for (Index i = 0; i < count; ++i) values.push_back(i % 3);
    std::vector<Index> expected{0};
    for (const Index value : values) expected.push_back(expected.back() + value);
    values.push_back(-1);
    EXPECT_EQ(Backend::host().cells().running_sums(values.data(), count), expected.back());
    EXPECT_EQ(values, expected);
  }
}

TEST(CellLoops, WhatIsNoPositionHasSomeCell) {
  Scene scene;
  scene.dimension = 2;
  scene.box = {3.0, 2.0, 0.0};
  const CellGrid grid(scene, Wrapped(), 0.4);
  for (const double x : {nan, HUGE_VAL, -HUGE_VAL, 1e300, -1e300}) {
    const double position[2] = {x, 1.0};
    EXPECT_GE(grid.number_of(position), 0) << x;
    EXPECT_LT(grid.number_of(position), grid.inside_count()) << x;
    EXPECT_GE(grid.beside(0, x, 0), 0) << x;
  }
  EXPECT_LT(grid.along(0, -1e300), -1000);
  EXPECT_GT(grid.along(0, 1e300), 1000);
}

TEST(CellLoops, OrderAndRangesAgree) {
  Scene scene;
  scene.dimension = 2;
  scene.box = {3.0, 2.0, 0.0};
  const CellGrid grid(scene, Wrapped(), 0.4);
  std::mt19937_64 random(3);
  std::array<std::vector<double>, 2> position;
  std::vector<std::int64_t> id;
  constexpr Index count = 400;
  for (Index i = 0; i < count; ++i) {
    // Half of the box stays empty, so that cells without particles lie before, between and behind.
    position[0].push_back(0.5 + 1.5 * std::generate_canonical<double, 53>(random));
    position[1].push_back(0.7 + 0.8 * std::generate_canonical<double, 53>(random));
    id.push_back((i * 7) % count);
  }
  const double* const at[3] = {position[0].data(), position[1].data(), nullptr};
  const exec::CellLoops& loops = Backend::host().cells();
  std::vector<Index> cell(count);
  loops.find_cells(grid, at, count, cell.data());
  std::vector<Index> order(count);
  loops.order(cell.data(), id.data(), count, grid.inside_count(), order.data());
  for (std::size_t n = 1; n < count; ++n) {
    const auto a = static_cast<std::size_t>(order[n - 1]);
    const auto b = static_cast<std::size_t>(order[n]);
    EXPECT_LT(std::pair(cell[a], id[a]), std::pair(cell[b], id[b]));
  }
  const std::vector<Index> unsorted = cell;
  Backend::host().storage().gather(unsorted.data(), order.data(), count, cell.data());
  std::vector<Index> begin(static_cast<std::size_t>(grid.padded_count()), -1);
  std::vector<Index> end(static_cast<std::size_t>(grid.padded_count()), -1);
  loops.find_ranges(grid, {0, grid.inside_count()}, cell.data(), count, begin.data(), end.data());
  Index next = 0;
  for (int c = 0; c < grid.inside_count(); ++c) {
    const auto index = static_cast<std::size_t>(grid.padded_index(grid.inside(c)));
    EXPECT_EQ(begin[index], next);
    while (next < count && cell[static_cast<std::size_t>(next)] == c) ++next;
    EXPECT_EQ(end[index], next);
  }
  EXPECT_EQ(next, count);
}

TEST(CellLoops, OrderDoesNotDependOnThreads) {
  constexpr int cells = 50;
  const int usual = omp_get_max_threads();
  for (const Index count : {0, 1, 3, 1000}) {
    std::vector<Index> cell;
    std::vector<std::int64_t> id;
    for (Index i = 0; i < count; ++i) {
      cell.push_back((i * 37) % cells);
      id.push_back((i * 7) % 1001);
    }
    std::vector<Index> expected(cell.size());
    std::iota(expected.begin(), expected.end(), 0);
    std::sort(expected.begin(), expected.end(), [&](Index a, Index b) {
      const auto key = [&](Index i) {
        return std::pair(cell[static_cast<std::size_t>(i)], id[static_cast<std::size_t>(i)]);
      };
      return key(a) < key(b);
    });
    for (const int threads : {1, 2, 3, 7, 64}) {
      omp_set_num_threads(threads);
      std::vector<Index> order(cell.size());
      Backend::host().cells().order(cell.data(), id.data(), count, cells, order.data());
      EXPECT_EQ(order, expected) << count << " particles, " << threads << " threads";
    }
  }
  omp_set_num_threads(usual);
}

TEST(Reductions, AreNotOverwrittenBeforeTheyAreWaitedFor) {
  exec::Reductions reductions;
  for (int round = 0; round < 3; ++round) {
    for (int n = 0; n < exec::Reductions::size / 2; ++n) reductions.take(1);
    reductions.wait({});
  }
  for (int n = 0; n < exec::Reductions::size; ++n) reductions.take(1);
  try {
    reductions.take(1);
    FAIL() << "more than there is room for";
  } catch (const std::logic_error& error) {
    EXPECT_STREQ(error.what(), "more is looked for at a time than there is room to note");
  }
}

TEST(CellLoops, FindWhoLeftTheBox) {
  const std::vector<double> x{0.0, 0.5, 1.0, -1e-300, nan, 0.9};
  const std::vector<double> y{0.0, 2.5, 0.0, 0.5, 0.5, 1.9};
  const double* const at[3] = {x.data(), y.data(), nullptr};
  const double box[3] = {1.0, 2.0, 0.0};
  std::vector<Index> found(6);
  found.resize(static_cast<std::size_t>(Backend::host().cells().find_outside(at, box, 2, 6, found.data())));
  EXPECT_EQ(found, (std::vector<Index>{1, 2, 3, 4}));
}

}  // namespace
