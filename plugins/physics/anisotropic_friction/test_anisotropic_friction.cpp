#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

TestScene with_density() {
  TestScene scene;
  scene.constants["density"] = 2.0;
  return scene;
}

/// What the framework's pass adds to the acceleration of a velocity (1, 0).
std::array<double, 2> push(const std::string& keys, double q11, double q12) {
  PluginHarness friction(PluginKind::physics, "anisotropic_friction", keys, with_density());
  friction.set("velocity", {1.0, 0.0}).set("density", {2.0}).set("acceleration", {0.0, 0.0});
  friction.set("order_tensor", {q11, q12});
  friction.run("axis of friction");
  friction.run("damping of velocity");
  return {friction.values("acceleration", 0).front(), friction.values("acceleration", 1).front()};
}

// f = -along n (n . u) - across (u - n (n . u)), with n at 30 degrees and u = (1, 0).
TEST(AnisotropicFriction, HoldsTheTwoDirectionsDifferently) {
  const double angle = std::numbers::pi / 6.0;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  for (const auto& [along, across] : {std::pair(0.2, 1.4), std::pair(1.4, 0.2)}) {
    const std::string keys = "along = " + std::to_string(along) + "\nacross = " + std::to_string(across) + "\naxis = ";
    const double x = -(along * c * c + across * (1.0 - c * c)) / 2.0;
    const double y = -(along - across) * c * s / 2.0;
    for (const auto& found : {push(keys + "30.0", 1.0, 0.0),
                              push(keys + "\"director\"", 0.6 * std::cos(2.0 * angle), 0.6 * std::sin(2.0 * angle))}) {
      EXPECT_NEAR(found[0], x, 1e-12);
      EXPECT_NEAR(found[1], y, 1e-12);
    }
  }
}

TEST(AnisotropicFriction, LimitsTheStepByTheLargerOne) {
  PluginHarness friction(PluginKind::physics, "anisotropic_friction", "along = 0.2\nacross = 1.4\naxis = 0.0",
                         with_density());
  EXPECT_DOUBLE_EQ(friction.step_limits().at("friction: 0.25 rho / xi of the larger friction"), 0.25 * 2.0 / 1.4);
}

}  // namespace
