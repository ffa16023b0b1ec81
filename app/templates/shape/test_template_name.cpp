#include <gtest/gtest.h>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

TEST(TemplateName, IsAsFarAsItsSurface) {
  PluginHarness plugin(PluginKind::shape, "template_name");
  const Shape& shape = plugin.shape();
  EXPECT_NEAR(shape.distance({0.5, 0.5, 0.0}), 0.2, 1e-15);   // in the hole
  EXPECT_NEAR(shape.distance({0.5, 0.8, 0.0}), -0.1, 1e-15);  // in the middle of the ring
  EXPECT_NEAR(shape.distance({0.95, 0.5, 0.0}), 0.05, 1e-15);
}

// What a run makes of it: no particle of the fluid is in the ring.
TEST(TemplateName, KeepsTheFluidOut) {
  TestScene scene;
  scene.across = 40;
  PluginHarness plugin(PluginKind::shape, "template_name", "", scene);
  const auto x = plugin.position(0);
  const auto y = plugin.position(1);
  const Shape& shape = plugin.shape();
  for (std::size_t n = 0; n < x.size(); ++n) EXPECT_GT(shape.distance({x[n], y[n], 0.0}), 0.0);
}

}  // namespace
