#include "time/step_control.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using namespace mesogen;

Scene scene() {
  Scene scene;
  scene.spacing = 0.1;
  scene.smoothing_length = 0.16;
  return scene;
}

StepLimits two_limits() {
  StepLimits limits;
  limits.add(StepCause::sound, "0.25 h / c0", 0.02);
  limits.add(StepCause::viscosity, "", 0.01);
  return limits;
}

TEST(StepControl, SmallestLimitOfThePluginsBindsAndIsNamed) {
  const StepControl control(scene(), two_limits(), {}, 1.0);
  const auto choice = control.choose(0.0, 0.0);
  EXPECT_EQ(choice.seconds, 0.01);
  EXPECT_EQ(choice.limit, "viscosity");
  EXPECT_FALSE(control.fixed());
  EXPECT_EQ(control.at_rest(), 0.01);
  EXPECT_EQ(control.limits().all().size(), 2U);
}

TEST(StepControl, MotionLimitsTheStep) {
  const StepControl control(scene(), two_limits(), {}, 1.0);
  const auto by_speed = control.choose(4.0, 0.0);  // 0.2 dx / |u|
  EXPECT_DOUBLE_EQ(by_speed.seconds, 0.005);
  EXPECT_EQ(by_speed.limit, "speed: 0.2 dx / |u|");
  const auto by_acceleration = control.choose(4.0, 1e4);  // 0.25 sqrt(h / |a|)
  EXPECT_DOUBLE_EQ(by_acceleration.seconds, 0.001);
  EXPECT_EQ(by_acceleration.limit, "acceleration: 0.25 sqrt(h / |a|)");
}

TEST(StepControl, FactorScalesEveryLimit) {
  const StepControl control(scene(), two_limits(), {}, 0.5);
  EXPECT_EQ(control.choose(0.0, 0.0).seconds, 0.005);
  EXPECT_DOUBLE_EQ(control.choose(4.0, 0.0).seconds, 0.0025);
}

TEST(StepControl, StepOfTheCaseIsTakenAsItIs) {
  const StepControl control(scene(), two_limits(), 0.5, 0.1);
  const auto choice = control.choose(100.0, 1e6);
  EXPECT_EQ(choice.seconds, 0.5);
  EXPECT_EQ(choice.limit, "time.step of the case");
  EXPECT_TRUE(control.fixed());
}

// The guard goes by what the start allowed.
TEST(StepControl, LimitsChangeWithThePlugins) {
  StepControl control(scene(), two_limits(), {}, 0.5);
  StepLimits faster;
  faster.add(StepCause::sound, "", 0.004);
  control.set_limits(faster);
  const auto choice = control.choose(0.0, 0.0);
  EXPECT_EQ(choice.seconds, 0.002);
  EXPECT_EQ(choice.limit, "sound");
  EXPECT_EQ(control.at_rest(), 0.005);
}

TEST(StepControl, NothingLimitsASceneAtRestWithoutPlugins) {
  const auto choice = StepControl(scene(), {}, {}, 1.0).choose(0.0, 0.0);
  EXPECT_EQ(choice.seconds, std::numeric_limits<double>::infinity());
  EXPECT_EQ(choice.limit, "nothing");
}

}  // namespace
