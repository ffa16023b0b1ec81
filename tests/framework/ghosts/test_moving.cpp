// Particles that are moved and placed in one loop, as on a device: they and their ghosts lie where two loops put them.

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "emulated_device.hpp"
#include "particles/field_loops.hpp"
#include "walled_scene.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

constexpr double speed[] = {0.3, -0.2};  // m/s

/// All particles go on for a time, none of them farther than `farthest` from where it was sorted.
void move(State& state, double time, double farthest) {
  exec::Array<double> velocity(state.backend.memory());
  const std::size_t count = state.particles.id.size();
  velocity.resize_for_overwrite(2 * count);
  const auto values = velocity.host(exec::Access::write);
  for (std::size_t i = 0; i < 2 * count; ++i) values[i] = speed[i / count];
  exec::MoveArguments<double> arguments{};
  for (int d = 0; d < 2; ++d) arguments.position[d] = state.particles.position[d].device(exec::Access::read_write);
  arguments.velocity = {std::as_const(velocity).device(), static_cast<std::ptrdiff_t>(count)};
  arguments.by = time;
  arguments.dimension = 2;
  state.order.move(arguments, farthest);
}

/// Of the fluid, walls and ghosts, relative to tiles.
std::vector<double> local_places(const State& state) {
  Neighbours<double, 2> grid{};
  state.neighbourhood.fill(grid, exec::Side::device);
  const auto count = static_cast<std::size_t>(state.particles.count() + state.neighbourhood.boundary_count());
  std::vector<double> places;
  for (const double* const along : grid.local) places.insert(places.end(), along, along + count);
  return places;
}

class Moving : public testing::Test {
 protected:
  Moving() : device_(memory_, false), scene_(channel(), Continuation::ghosts, Precision::double_precision, device_) {}

  exec::EmulatedMemory memory_;
  const EmulatedDevice device_;
  Walled scene_;
};

TEST_F(Moving, AndPlacingInOneLoopIsThatInTwo) {
  State& state = scene_.state();
  const std::vector<double> before = local_places(state);
  const std::uint64_t version = state.neighbourhood.version();
  move(state, 0.001, 0.001);
  EXPECT_TRUE(state.order.settled());
  EXPECT_GT(state.neighbourhood.version(), version);
  const std::vector<double> together = local_places(state);
  state.order.mark_moved();
  state.order.settle();
  EXPECT_EQ(local_places(state), together);
  EXPECT_NE(before, together);
  EXPECT_EQ(state.neighbourhood.sortings(), 1);
}

// Where a particle may have strayed somebody has to look.
TEST_F(Moving, FarLeavesNeighboursToBeSettled) {
  State& state = scene_.state();
  const double before = state.particles.position[0].host()[0];
  move(state, 0.001, state.neighbourhood.skin());
  EXPECT_FALSE(state.order.settled());
  EXPECT_DOUBLE_EQ(state.particles.position[0].host()[0], before + 0.001 * speed[0]);
  state.order.sort_for_memory();
  move(state, 0.001, 0.001);
  EXPECT_FALSE(state.order.settled()) << "neighbours of that order are not found yet";
}

TEST_F(Moving, IsLeftToTheLoopsOfTheHostWhereTheyAre) {
  Walled host(channel(), Continuation::ghosts, Precision::double_precision, Backend::host());
  move(host.state(), 0.001, 0.001);
  EXPECT_FALSE(host.state().order.settled());
}

}  // namespace
