// The cell grid finds every pair within the support once, and nothing else: against all pairs, one by one.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>
#include <vector>

#include "neighbour_runs.hpp"
#include "particle_scene.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

/// Ids of a pair and its separation, rounded to parts of 1e-9 of the support's length.
using FoundPair = std::tuple<std::int64_t, std::int64_t, std::int64_t, std::int64_t>;

std::int64_t rounded(double separation, double radius) { return std::llround(separation / radius * 1e9); }

/// As pair sums see them: by blocks on the host, by runs on a device.
enum class Form { blocks, runs };

template <class Action>
void visit_runs(const Neighbours<double, 2>& grid, Index i, Form form, const Action& action) {
  if (form == Form::blocks) {
    for (auto n = grid.block_begin[i]; n < grid.block_begin[i + 1]; ++n) {
      const NeighbourBlock& block = grid.block[n];
      EXPECT_GT(block.lanes, 0);
      EXPECT_LE(block.lanes, NeighbourBlock::width<double>);
      for (int lane = 0; lane < block.lanes; ++lane) {
        const Index j = block.particle(lane);
        action(j, j + 1, grid.offset[0][NeighbourBlock::most_shift + block.shift_at(lane, 0)],
               grid.offset[1][NeighbourBlock::most_shift + block.shift_at(lane, 1)]);
      }
    }
    return;
  }
  for (Index n = grid.run_begin[i]; n < grid.run_begin[i + 1]; ++n) {
    const NeighbourRun& run = grid.run[n];
    EXPECT_GT(run.count, 0);
    action(run.first, run.first + run.count, run.shift[0] * grid.width[0], run.shift[1] * grid.width[1]);
  }
}

std::vector<FoundPair> pairs_in_grid(State& state, Form form) {
  state.order.settle();
  Neighbours<double, 2> grid{};
  state.neighbourhood.fill(grid, exec::Side::host);
  const Runs runs(grid, state.neighbourhood.neighbour_range());
  runs.give_to(grid);
  const GhostView ghosts = state.neighbourhood.ghost_view(exec::Side::host);
  const auto count = state.particles.count();
  const auto id = state.particles.id.host();
  const double radius = state.scene.support;
  std::vector<FoundPair> pairs;
  for (Index i = 0; i < count; ++i) {
    visit_runs(grid, i, form, [&](Index begin, Index end, double across, double up) {
      for (Index j = begin; j < end; ++j) {
        const double x = grid.local[0][i] - across - grid.local[0][j];
        const double y = grid.local[1][i] - up - grid.local[1][j];
        if (std::hypot(x, y) >= radius) continue;
        const Index real = j < count ? j : ghosts.source[j - ghosts.first];
        pairs.emplace_back(id[static_cast<std::size_t>(i)], id[static_cast<std::size_t>(real)], rounded(x, radius),
                           rounded(y, radius));
      }
    });
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// All pairs of particles and images, tried one by one.
std::vector<FoundPair> pairs_by_trial(const State& state) {
  const auto id = state.particles.id.host();
  const auto position = exec::pointers(state.particles.position, exec::Side::host);
  const auto& box = state.scene.box;
  const double radius = state.scene.support;
  std::vector<FoundPair> pairs;
  for (std::size_t i = 0; i < id.size(); ++i) {
    for (std::size_t j = 0; j < id.size(); ++j) {
      for (int across = -2; across <= 2; ++across) {
        for (int up = -2; up <= 2; ++up) {
          const double x = position[0][i] - position[0][j] + across * box[0];
          const double y = position[1][i] - position[1][j] + up * box[1];
          if (std::hypot(x, y) < radius) pairs.emplace_back(id[i], id[j], rounded(x, radius), rounded(y, radius));
        }
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// The same pairs, each found once. Separations agree to a part in 1e9, which may round to neighbouring numbers.
void expect_all_pairs(State& state) {
  const auto expected = pairs_by_trial(state);
  for (const Form form : {Form::blocks, Form::runs}) {
    const auto found = pairs_in_grid(state, form);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t n = 0; n < found.size(); ++n) {
      ASSERT_EQ(std::get<0>(found[n]), std::get<0>(expected[n]));
      ASSERT_EQ(std::get<1>(found[n]), std::get<1>(expected[n]));
      ASSERT_NEAR(static_cast<double>(std::get<2>(found[n])), static_cast<double>(std::get<2>(expected[n])), 1.0);
      ASSERT_NEAR(static_cast<double>(std::get<3>(found[n])), static_cast<double>(std::get<3>(expected[n])), 1.0);
    }
  }
}

std::array<std::vector<double>, 2> anywhere(const std::array<double, 3>& box, int count, unsigned seed) {
  std::mt19937_64 random(seed);
  std::array<std::vector<double>, 2> points;
  for (int n = 0; n < count; ++n)
    for (std::size_t d = 0; d < 2; ++d) points[d].push_back(box[d] * std::generate_canonical<double, 53>(random));
  return points;
}

class NeighbourSearch : public testing::TestWithParam<const char*> {
 protected:
  [[nodiscard]] ParticleScene::Options options(double width, double height) const {
    ParticleScene::Options options;
    options.box = {width, height, 0.0};
    options.spacing = 1.0;
    options.boundary = GetParam();
    return options;
  }
};

TEST_P(NeighbourSearch, FindsAllPairsOfScatteredParticles) {
  // From a support of nearly half the box (4 m of 8.001 m) over narrow boxes to one of several tiles.
  for (const auto& [width, height] : {std::pair{8.001, 8.001}, std::pair{8.2, 8.2}, std::pair{8.001, 30.0},
                                      std::pair{41.0, 8.3}, std::pair{17.0, 13.0}, std::pair{150.0, 9.0}}) {
    for (const unsigned seed : {1U, 2U}) {
      const auto at = options(width, height);
      ParticleScene scene(at, anywhere(at.box, 150, seed));
      SCOPED_TRACE(testing::Message() << "box " << width << " x " << height << ", seed " << seed);
      expect_all_pairs(scene.state());
    }
  }
}

TEST_P(NeighbourSearch, FindsParticlesOnTheFaces) {
  const auto at = options(12.0, 9.0);
  std::array<std::vector<double>, 2> points;
  const double edge[2][5] = {{0.0, std::nextafter(12.0, 0.0), 12.0, -1e-18, 6.0},
                             {0.0, std::nextafter(9.0, 0.0), 9.0, -1e-18, 4.5}};
  for (const double x : edge[0]) {
    for (const double y : edge[1]) {
      points[0].push_back(x);
      points[1].push_back(y);
    }
  }
  ParticleScene scene(at, points);
  for (int d = 0; d < 2; ++d) {
    for (const double x : scene.state().particles.position[static_cast<std::size_t>(d)].host()) {
      EXPECT_GE(x, 0.0);
      EXPECT_LT(x, at.box[static_cast<std::size_t>(d)]);
    }
  }
  expect_all_pairs(scene.state());
}

TEST_P(NeighbourSearch, StaysRightWhileParticlesMoveInsideTheSkin) {
  const auto at = options(20.0, 14.0);
  ParticleScene scene(at, jittered(20, 14, 1.0, 0.4));
  const auto scattered = [](std::int64_t id) {
    const double angle = 2.4 * static_cast<double>(id);
    return std::array{0.015 * std::cos(angle), 0.015 * std::sin(angle)};
  };
  for (int n = 0; n < 3; ++n) {
    scene.move(scattered);
    expect_all_pairs(scene.state());
  }
  EXPECT_EQ(scene.state().neighbourhood.sortings(), 1) << "moved by 0.045 m in all, half the skin is 0.05 m";
  scene.move(scattered);
  expect_all_pairs(scene.state());
  EXPECT_EQ(scene.state().neighbourhood.sortings(), 2);
}

TEST_P(NeighbourSearch, StaysRightWhenParticlesLeaveTheBox) {
  const auto at = options(20.0, 14.0);
  ParticleScene scene(at, jittered(20, 14, 1.0, 0.4));
  for (int n = 0; n < 4; ++n) {
    scene.move([](std::int64_t id) { return std::array{7.0 + 0.01 * static_cast<double>(id % 7), -5.0}; });
    expect_all_pairs(scene.state());
  }
  EXPECT_EQ(scene.state().neighbourhood.sortings(), 5);
}

TEST_P(NeighbourSearch, BlocksHoldLittleButNeighbours) {
  const auto at = options(60.0, 60.0);
  ParticleScene scene(at, jittered(60, 60, 1.0, 0.2));
  State& state = scene.state();
  state.order.settle();
  Neighbours<double, 2> grid{};
  state.neighbourhood.fill(grid, exec::Side::host);
  const auto count = static_cast<double>(state.particles.count());
  const auto neighbours = static_cast<double>(pairs_in_grid(state, Form::blocks).size()) / count;
  const auto blocks = static_cast<double>(grid.block_begin[state.particles.count()]) / count;
  EXPECT_GT(neighbours, 48.0);
  EXPECT_LT(blocks * NeighbourBlock::width<double> / neighbours, 1.65);
  EXPECT_NEAR(NeighbourBlocks::expected(state.scene.support + state.neighbourhood.skin(), grid.width[1],
                                        NeighbourBlock::width<double>) /
                  blocks,
              1.0, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Boundaries, NeighbourSearch, testing::Values("periodic_ghosts", "periodic_wrap"),
                         [](const auto& set) { return std::string(set.param); });

}  // namespace
