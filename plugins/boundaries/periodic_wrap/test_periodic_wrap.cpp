#include <gtest/gtest.h>

#include "boundary_checks.hpp"
#include "mesogen/testing/plugin_harness.hpp"
#include "test_plugins.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

TEST(PeriodicWrap, KeepsParticlesInside) { expect_keeps_inside("periodic_wrap"); }

TEST(PeriodicWrap, WrapsTheGridAndMakesNoGhosts) {
  const auto boundary = built_plugins().make_boundary("periodic_wrap", 2);
  const Scene scene = scene_of(2, {1.0, 1.0, 0.0});
  EXPECT_EQ(boundary->continuation(0), Continuation::wrapped);
  EXPECT_EQ(boundary->continuation(1), Continuation::wrapped);
  EXPECT_TRUE(ghosts_of(*boundary, scene, lattice(scene, 8), 0.4).source.empty());
}

TEST(PeriodicWrap, FindsTheNeighboursThatGhostsGive) {
  const auto sums = [](const char* boundary) {
    mesogen::testing::PluginHarness harness(PluginKind::boundary, boundary);
    harness.give("velocity");
    return harness.values("velocity_laplacian", 1);
  };
  const auto wrapped = sums("periodic_wrap");
  const auto copied = sums("periodic_ghosts");
  for (std::size_t i = 0; i < wrapped.size(); ++i) EXPECT_NEAR(wrapped[i], copied[i], 1e-9) << "particle " << i;
}

TEST(PeriodicWrap, LeavesThirdAxisAloneInTwoDimensions) {
  const auto boundary = built_plugins().make_boundary("periodic_wrap", 2);
  std::array<double, 3> position{1.5, -0.5, 7.0};
  std::array<std::int32_t, 3> images{};
  boundary->keep_inside(scene_of(2, {1.0, 1.0, 0.0}), position.data(), images.data());
  EXPECT_EQ(position, (std::array<double, 3>{0.5, 0.5, 7.0}));
  EXPECT_EQ(images, (std::array<std::int32_t, 3>{1, -1, 0}));
}

}  // namespace
