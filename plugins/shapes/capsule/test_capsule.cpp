#include <gtest/gtest.h>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

TEST(Capsule, IsAsFarAsItsSidesAndEnds) {
  PluginHarness plugin(PluginKind::shape, "capsule", "from = [0.4, 0.5]\nto = [0.6, 0.5]\nradius = 0.2");
  const Shape& capsule = plugin.shape();
  EXPECT_NEAR(capsule.distance({0.5, 0.5, 0.0}), -0.2, 1e-15);
  EXPECT_NEAR(capsule.distance({0.5, 0.8, 0.0}), 0.1, 1e-15);
  EXPECT_NEAR(capsule.distance({0.9, 0.5, 0.0}), 0.1, 1e-15);
  EXPECT_NEAR(capsule.distance({0.75, 0.7, 0.0}), 0.05, 1e-15);  // 3, 4, 5
  EXPECT_NEAR(capsule.centre()[0], 0.5, 1e-15);
}

TEST(Capsule, IsADiscWithoutLength) {
  PluginHarness plugin(PluginKind::shape, "capsule", "from = [0.5, 0.5]\nto = [0.5, 0.5]\nradius = 0.2");
  EXPECT_NEAR(plugin.shape().distance({0.8, 0.9, 0.0}), 0.3, 1e-15);
}

}  // namespace
