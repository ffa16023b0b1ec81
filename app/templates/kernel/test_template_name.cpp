#include <gtest/gtest.h>

#include <numbers>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

TEST(TemplateName, HasTheKnownShape) {
  PluginHarness plugin(PluginKind::kernel, "template_name");
  const auto shape = plugin.kernel().shape();
  EXPECT_EQ(shape.support(), 2.5);
  EXPECT_NEAR(shape.value(1.0) / shape.value(0.0), 38.0 / 115.0, 1e-14);  // (3^4 - 5) / (5^4 - 5 * 3^4 + 10)
  EXPECT_NEAR(shape.normalisation(2), 96.0 / (1199.0 * std::numbers::pi), 1e-14);
}

// What a run makes with it: on a lattice the volume of a particle is the square of the spacing, as well as the kernel
// sums.
TEST(TemplateName, SumsToTheVolumeOnALattice) {
  TestScene scene;
  scene.arrangement = "lattice";
  PluginHarness plugin(PluginKind::kernel, "template_name", "", scene);
  EXPECT_NEAR(plugin.value("volume") / (0.05 * 0.05), 1.0, 0.02);
}

}  // namespace
