#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

TEST(Reuleaux, HasTheSameWidthInEveryDirection) {
  PluginHarness plugin(PluginKind::shape, "reuleaux", "centre = [0.5, 0.5]\nwidth = 0.4");
  const Shape& shape = plugin.shape();
  // From a corner to the arc on the other side.
  const double corner = 0.4 / std::numbers::sqrt3;
  EXPECT_NEAR(shape.distance({0.5, 0.5 + corner, 0.0}), 0.0, 1e-15);
  EXPECT_NEAR(shape.distance({0.5, 0.5 + corner - 0.4, 0.0}), 0.0, 1e-15);
  EXPECT_NEAR(shape.distance({0.5, 0.5, 0.0}), corner - 0.4, 1e-15);
}

TEST(Reuleaux, LeavesTheFluidItsArea) {
  TestScene scene;
  scene.across = 80;
  PluginHarness plugin(PluginKind::shape, "reuleaux", "centre = [0.5, 0.5]\nwidth = 0.4", scene);
  const double area = 0.5 * (std::numbers::pi - std::numbers::sqrt3) * 0.16;
  EXPECT_NEAR(plugin.scene().fluid_volume, 1.0 - area, 1e-3);
}

}  // namespace
