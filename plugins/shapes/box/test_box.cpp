#include <gtest/gtest.h>

#include <cmath>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

TEST(Box, IsAsFarAsItsEdgesAndCorners) {
  PluginHarness plugin(PluginKind::shape, "box", "centre = [0.5, 0.5]\nsize = [0.4, 0.2]");
  const Shape& box = plugin.shape();
  EXPECT_NEAR(box.distance({0.5, 0.5, 0.0}), -0.1, 1e-15);
  EXPECT_NEAR(box.distance({0.65, 0.5, 0.0}), -0.05, 1e-15);
  EXPECT_NEAR(box.distance({0.5, 0.75, 0.0}), 0.15, 1e-15);
  EXPECT_NEAR(box.distance({0.73, 0.64, 0.0}), 0.05, 1e-15);  // 3, 4, 5
}

TEST(Box, TurnsAboutItsCentre) {
  PluginHarness plugin(PluginKind::shape, "box", "centre = [0.5, 0.5]\nsize = [0.4, 0.2]\nrotation = 90.0");
  EXPECT_NEAR(plugin.shape().distance({0.5, 0.75, 0.0}), 0.05, 1e-15);
  PluginHarness slanted(PluginKind::shape, "box", "centre = [0.5, 0.5]\nsize = [0.4, 0.2]\nrotation = 30.0");
  const double along = 0.3;  // of the axis that 30 degrees turn
  EXPECT_NEAR(slanted.shape().distance({0.5 + along * std::cos(M_PI / 6), 0.5 + along * std::sin(M_PI / 6), 0.0}), 0.1,
              1e-15);
}

TEST(Box, RoundsItsCorners) {
  PluginHarness plugin(PluginKind::shape, "box", "centre = [0.5, 0.5]\nsize = [0.4, 0.2]\nrounding = 0.1");
  const Shape& box = plugin.shape();
  EXPECT_NEAR(box.distance({0.75, 0.5, 0.0}), 0.05, 1e-15);
  EXPECT_NEAR(box.distance({0.7, 0.6, 0.0}), 0.1 * std::sqrt(2.0) - 0.1, 1e-15);
}

TEST(Box, RefusesCornersThatDoNotFit) {
  try {
    (void)PluginHarness(PluginKind::shape, "box", "centre = [0.5, 0.5]\nsize = [0.4, 0.2]\nrounding = 0.2").scene();
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what())
                  .find("solids.tested.rounding: is more than half of the shorter edge: take at most 0.1"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
