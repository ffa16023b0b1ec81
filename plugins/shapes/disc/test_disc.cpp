#include <gtest/gtest.h>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

TEST(Disc, IsAsFarAsItsRim) {
  PluginHarness plugin(PluginKind::shape, "disc", "centre = [0.5, 0.4]\nradius = 0.25");
  const Shape& disc = plugin.shape();
  EXPECT_DOUBLE_EQ(disc.distance({0.5, 0.4, 0.0}), -0.25);
  EXPECT_DOUBLE_EQ(disc.distance({0.5, 0.9, 0.0}), 0.25);
  EXPECT_NEAR(disc.distance({0.8, 0.8, 0.0}), 0.25, 1e-15);
  EXPECT_EQ(disc.centre(), (Shape::Point{0.5, 0.4, 0.0}));
}

}  // namespace
