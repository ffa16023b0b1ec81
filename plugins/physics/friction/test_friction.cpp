#include <gtest/gtest.h>

#include "fake_pass_context.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

TEST(Friction, SlowsTheFlowByItsSpeed) {
  const PhysicsUnderTest friction("friction", {{"coefficient", 0.6}});
  FakePassContext context(2);
  context.set("velocity", {3.0, -4.0});
  context.set("density", {2.0});
  context.set("acceleration", {1.0, 1.0});
  friction.run("friction", context);
  for (const Index i : {0, 1}) {
    EXPECT_DOUBLE_EQ(context.at("acceleration", 0, i), 1.0 - 0.6 / 2.0 * 3.0);
    EXPECT_DOUBLE_EQ(context.at("acceleration", 1, i), 1.0 + 0.6 / 2.0 * 4.0);
  }
}

TEST(Friction, LimitsTheStepWhereTheDensityIsKnown) {
  const PhysicsUnderTest friction("friction", {{"coefficient", 0.6}});
  Scene scene;
  EXPECT_TRUE(friction.limits(scene).empty());
  scene.constants["density"] = 2.0;
  EXPECT_DOUBLE_EQ(friction.limits(scene).at("friction: 0.25 rho / xi"), 0.25 * 2.0 / 0.6);
  EXPECT_TRUE(PhysicsUnderTest("friction", {{"coefficient", 0.0}}).limits(scene).empty());
}

}  // namespace
