#include <gtest/gtest.h>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

TEST(Friction, SlowsTheFlowByItsSpeed) {
  PluginHarness friction(PluginKind::physics, "friction", "coefficient = 0.6");
  friction.set("velocity", {3.0, -4.0}).set("density", {2.0}).set("acceleration", {1.0, 1.0});
  friction.run("damping of velocity");
  for (const double a : friction.values("acceleration", 0)) EXPECT_DOUBLE_EQ(a, 1.0 - 0.6 / 2.0 * 3.0);
  for (const double a : friction.values("acceleration", 1)) EXPECT_DOUBLE_EQ(a, 1.0 + 0.6 / 2.0 * 4.0);
}

TEST(Friction, LimitsTheStepWhereTheDensityIsKnown) {
  const auto limits = [](const char* keys, const TestScene& scene) {
    return PluginHarness(PluginKind::physics, "friction", keys, scene).step_limits();
  };
  TestScene scene;
  EXPECT_TRUE(limits("coefficient = 0.6", scene).empty());
  scene.constants["density"] = 2.0;
  EXPECT_DOUBLE_EQ(limits("coefficient = 0.6", scene).at("friction: 0.25 rho / xi"), 0.25 * 2.0 / 0.6);
  EXPECT_TRUE(limits("coefficient = 0.0", scene).empty());
}

}  // namespace
