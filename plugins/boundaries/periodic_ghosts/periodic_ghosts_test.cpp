#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <map>

#include "boundary_checks.hpp"
#include "test_plugins.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

std::unique_ptr<Boundary> ghosts() { return built_plugins().make_boundary("periodic_ghosts"); }

TEST(PeriodicGhosts, KeepsParticlesInside) { expect_keeps_inside("periodic_ghosts"); }

TEST(PeriodicGhosts, CountsOnALattice) {
  EXPECT_FALSE(ghosts()->wraps(0));
  const Scene flat = scene_of(2, {10.0, 10.0, 0.0});
  // Three layers of the lattice lie within 3 spacings of each face: the box grows by them all round.
  EXPECT_EQ(copies_of(*ghosts(), flat, lattice(flat, 20), 1.5).source.size(), 26U * 26U - 20U * 20U);
  const Scene solid = scene_of(3, {10.0, 10.0, 10.0});
  EXPECT_EQ(copies_of(*ghosts(), solid, lattice(solid, 10), 2.0).source.size(), 14U * 14U * 14U - 1000U);
}

TEST(PeriodicGhosts, CopiesACornerThreeTimes) {
  const Scene scene = scene_of(2, {10.0, 5.0, 0.0});
  const Points points{{{0.2, 9.8, 5.0, 5.0}, {0.3, 4.9, 2.5, 0.1}, {0, 0, 0, 0}}};
  const Copies copies = copies_of(*ghosts(), scene, points, 1.0);
  const std::vector<Index> source{0, 0, 0, 1, 1, 1, 3};
  const std::vector<std::array<double, 3>> offset{{10, 0, 0}, {0, 5, 0},    {10, 5, 0}, {-10, 0, 0},
                                                  {0, -5, 0}, {-10, -5, 0}, {0, 5, 0}};
  EXPECT_EQ(copies.source, source);
  EXPECT_EQ(copies.offset, offset);
}

TEST(PeriodicGhosts, CopiesToBothSidesOfANarrowBox) {
  const Scene scene = scene_of(2, {1.0, 10.0, 0.0});
  const Copies copies = copies_of(*ghosts(), scene, {{{0.5}, {5.0}, {0.0}}}, 0.75);
  EXPECT_EQ(copies.offset, (std::vector<std::array<double, 3>>{{1, 0, 0}, {-1, 0, 0}}));
}

TEST(PeriodicGhosts, GivesEveryNeighbourThatTheNearestImageGives) {
  for (const int dimension : {2, 3}) {
    const Scene scene = scene_of(dimension, {1.0, 1.3, 0.9});
    const Points points = scattered(scene, 300, 7);
    constexpr double reach = 0.31;
    const Copies copies = copies_of(*ghosts(), scene, points, reach);
    const auto distance = [&](Index i, Index j, const std::array<double, 3>& offset) {
      double square = 0.0;
      for (unsigned d = 0; d < static_cast<unsigned>(dimension); ++d)
        square +=
            std::pow(points[d][static_cast<std::size_t>(i)] - points[d][static_cast<std::size_t>(j)] - offset[d], 2);
      return std::sqrt(square);
    };
    for (Index i = 0; i < 300; ++i) {
      std::map<Index, int> found;
      std::map<Index, int> expected;
      for (Index j = 0; j < 300; ++j) {
        std::array<double, 3> image{};
        for (unsigned d = 0; d < static_cast<unsigned>(dimension); ++d) {
          const double separation = points[d][static_cast<std::size_t>(i)] - points[d][static_cast<std::size_t>(j)];
          image[d] = scene.box[d] * std::round(separation / scene.box[d]);
        }
        if (distance(i, j, image) < reach) ++expected[j];
        if (distance(i, j, {}) < reach) ++found[j];
      }
      for (std::size_t c = 0; c < copies.source.size(); ++c)
        if (distance(i, copies.source[c], copies.offset[c]) < reach) ++found[copies.source[c]];
      ASSERT_EQ(found, expected) << "neighbours of particle " << i << " in " << dimension << " dimensions";
    }
  }
}

TEST(PeriodicGhosts, OrderDoesNotDependOnThreads) {
  const Scene scene = scene_of(2, {1.0, 1.0, 0.0});
  const Points points = scattered(scene, 30000, 3);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const Copies one = copies_of(*ghosts(), scene, points, 0.1);
  omp_set_num_threads(5);
  const Copies five = copies_of(*ghosts(), scene, points, 0.1);
  omp_set_num_threads(threads);
  EXPECT_GT(one.source.size(), 10000U);
  EXPECT_EQ(one.source, five.source);
  EXPECT_EQ(one.offset, five.offset);
}

TEST(PeriodicGhosts, CopiesHaveTheValuesOfTheirSources) {
  const Scene scene = scene_of(2, {1.0, 1.0, 0.0});
  const auto boundary = ghosts();
  const Copies copies = copies_of(*boundary, scene, scattered(scene, 50, 1), 0.3);
  ASSERT_GT(copies.source.size(), 0U);
  std::vector<Extension> rules(2 * copies.source.size());
  boundary->carry_over(scene, "velocity", 2, copies, rules);
  for (const Extension& rule : rules) {
    EXPECT_EQ(rule.factor, 1.0);
    EXPECT_EQ(rule.summand, 0.0);
  }
}

TEST(PeriodicGhosts, CopiesNothingOfNothing) {
  const Scene scene = scene_of(2, {1.0, 1.0, 0.0});
  EXPECT_TRUE(copies_of(*ghosts(), scene, {}, 0.3).source.empty());
}

}  // namespace
