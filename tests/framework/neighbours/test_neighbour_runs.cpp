// What a device has to do for a sum over neighbours, counted on the host.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "neighbour_runs.hpp"
#include "particle_scene.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

constexpr Index threads = 32;  // of a warp

/// Turns that a warp takes in the loop over neighbours, per particle: all its threads go on until the last is done.
double turns_of_warps(const std::vector<Index>& neighbours) {
  double turns = 0.0;
  const auto count = static_cast<Index>(neighbours.size());
  for (Index first = 0; first < count; first += threads)
    turns +=
        threads * *std::max_element(neighbours.begin() + first, neighbours.begin() + std::min(count, first + threads));
  return turns / count;
}

struct Counted {
  double within_support, in_runs, turns, runs;  // per particle
};

Counted count_neighbours(ParticleScene& scene) {
  State& state = scene.state();
  state.order.settle();
  Neighbours<float, 2> grid{};
  state.neighbourhood.fill(grid, exec::Side::host);
  const Runs runs(grid, state.neighbourhood.neighbour_range());
  const Index count = grid.particle_count;
  std::vector<Index> neighbours;
  Counted counted{};
  for (Index i = 0; i < count; ++i) {
    Index all = 0;
    for (Index n = runs.begin()[static_cast<std::size_t>(i)]; n < runs.begin()[static_cast<std::size_t>(i) + 1]; ++n) {
      const NeighbourRun& run = runs.run()[static_cast<std::size_t>(n)];
      all += run.count;
      for (Index j = run.first; j < run.first + run.count; ++j) {
        const double x = double(grid.local[0][i]) - run.shift[0] * grid.width[0] - double(grid.local[0][j]);
        const double y = double(grid.local[1][i]) - run.shift[1] * grid.width[1] - double(grid.local[1][j]);
        if (x * x + y * y < state.scene.support * state.scene.support) counted.within_support += 1.0;
      }
    }
    neighbours.push_back(all);
    counted.in_runs += all;
  }
  counted.within_support /= count;
  counted.in_runs /= count;
  counted.turns = turns_of_warps(neighbours);
  counted.runs = static_cast<double>(runs.run().size()) / count;
  return counted;
}

/// As disordered as a flow makes them; a box of several tiles.
ParticleScene disordered(const char* boundary) {
  ParticleScene::Options options;
  options.box = {200.0, 100.0, 0.0};
  options.spacing = 1.0;
  options.boundary = boundary;
  options.precision = Precision::single_precision;
  return {options, jittered(200, 100, 1.0, 0.3)};
}

// About 50 neighbours lie within the support, and some beyond it in the runs.
TEST(NeighbourRuns, AWarpTakesFewTurns) {
  for (const char* const boundary : {"periodic_wrap", "periodic_ghosts"}) {
    ParticleScene scene = disordered(boundary);
    const Counted counted = count_neighbours(scene);
    RecordProperty(std::string(boundary) + ": turns", std::to_string(counted.turns));
    RecordProperty(std::string(boundary) + ": runs", std::to_string(counted.runs));
    EXPECT_NEAR(counted.within_support, 50.0, 1.5) << boundary;
    EXPECT_LE(counted.in_runs, 62.0) << boundary;
    EXPECT_LE(counted.turns, 72.0) << boundary;
    EXPECT_LE(counted.runs, 6.5) << boundary << ": memory per particle is eight bytes each";
  }
}

// A run counts up to 255: where more particles follow each other, there are several.
TEST(NeighbourRuns, LongOnesAreCut) {
  ParticleScene::Options options;
  options.box = {20.0, 20.0, 0.0};
  options.spacing = 1.0;
  std::array<std::vector<double>, 2> points;
  for (int n = 0; n < 700; ++n) {
    points[0].push_back(10.0 + 1e-4 * n);
    points[1].push_back(10.0);
  }
  ParticleScene scene(options, points);
  State& state = scene.state();
  state.order.settle();
  Neighbours<double, 2> grid{};
  state.neighbourhood.fill(grid, exec::Side::host);
  const Runs runs(grid, state.neighbourhood.neighbour_range());
  int all = 0;
  for (Index n = runs.begin()[0]; n < runs.begin()[1]; ++n) all += runs.run()[static_cast<std::size_t>(n)].count;
  EXPECT_EQ(all, 700);
  EXPECT_GE(runs.begin()[1], 3);
}

}  // namespace
