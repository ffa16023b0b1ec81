#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "boundary_checks.hpp"
#include "test_plugins.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

std::unique_ptr<Boundary> ghosts() { return built_plugins().make_boundary("periodic_ghosts", 2); }

TEST(PeriodicGhosts, KeepsParticlesInside) { expect_keeps_inside("periodic_ghosts"); }

TEST(PeriodicGhosts, CountsOnALattice) {
  EXPECT_EQ(ghosts()->continuation(0), Continuation::ghosts);
  const Scene flat = scene_of(2, {10.0, 10.0, 0.0});
  // Three layers of the lattice lie within 3 spacings of each face: the box grows by them all round.
  EXPECT_EQ(ghosts_of(*ghosts(), flat, lattice(flat, 20), 1.5).source.size(), 26U * 26U - 20U * 20U);
  const Scene solid = scene_of(3, {10.0, 10.0, 10.0});
  EXPECT_EQ(ghosts_of(*ghosts(), solid, lattice(solid, 10), 2.0).source.size(), 14U * 14U * 14U - 1000U);
}

TEST(PeriodicGhosts, RepeatsACornerThreeTimes) {
  const Scene scene = scene_of(2, {10.0, 5.0, 0.0});
  const Points points{{{0.2, 9.8, 5.0, 5.0}, {0.3, 4.9, 2.5, 0.1}, {0, 0, 0, 0}}};
  const GhostList list = ghosts_of(*ghosts(), scene, points, 1.0);
  std::vector<std::pair<Index, std::array<double, 3>>> found;
  for (std::size_t n = 0; n < list.source.size(); ++n) found.emplace_back(list.source[n], list.offset[n]);
  std::ranges::sort(found);
  const std::vector<std::pair<Index, std::array<double, 3>>> expected{
      {0, {0, 5, 0}},   {0, {10, 0, 0}}, {0, {10, 5, 0}}, {1, {-10, -5, 0}},
      {1, {-10, 0, 0}}, {1, {0, -5, 0}}, {3, {0, 5, 0}}};
  EXPECT_EQ(found, expected);
}

TEST(PeriodicGhosts, RepeatsOnBothSidesOfANarrowBox) {
  const Scene scene = scene_of(2, {1.0, 10.0, 0.0});
  const GhostList list = ghosts_of(*ghosts(), scene, {{{0.5}, {5.0}, {0.0}}}, 0.75);
  EXPECT_EQ(list.offset, (std::vector<std::array<double, 3>>{{-1, 0, 0}, {1, 0, 0}}));
}

TEST(PeriodicGhosts, GivesEveryNeighbourThatTheNearestImageGives) {
  for (const int dimension : {2, 3}) {
    const Scene scene = scene_of(dimension, {1.0, 1.3, 0.9});
    const Points points = scattered(scene, 300, 7);
    constexpr double reach = 0.31;
    const GhostList list = ghosts_of(*ghosts(), scene, points, reach);
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
      for (std::size_t c = 0; c < list.source.size(); ++c)
        if (distance(i, list.source[c], list.offset[c]) < reach) ++found[list.source[c]];
      ASSERT_EQ(found, expected) << "neighbours of particle " << i << " in " << dimension << " dimensions";
    }
  }
}

TEST(PeriodicGhosts, OrderDoesNotDependOnThreads) {
  const Scene scene = scene_of(2, {1.0, 1.0, 0.0});
  const Points points = scattered(scene, 30000, 3);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const GhostList one = ghosts_of(*ghosts(), scene, points, 0.1);
  omp_set_num_threads(5);
  const GhostList five = ghosts_of(*ghosts(), scene, points, 0.1);
  omp_set_num_threads(threads);
  EXPECT_GT(one.source.size(), 10000U);
  EXPECT_EQ(one.source, five.source);
  EXPECT_EQ(one.offset, five.offset);
}

TEST(PeriodicGhosts, RepeatsNothingOfNothing) {
  const Scene scene = scene_of(2, {1.0, 1.0, 0.0});
  EXPECT_TRUE(ghosts_of(*ghosts(), scene, {}, 0.3).source.empty());
}

}  // namespace
