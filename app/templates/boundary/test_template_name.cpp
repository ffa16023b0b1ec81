#include <gtest/gtest.h>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

TEST(TemplateName, BringsAParticleBackIn) {
  PluginHarness plugin(PluginKind::boundary, "template_name");  // a box of 1 m
  double position[2] = {1.25, -0.5};
  std::int32_t images[2] = {0, 0};
  plugin.boundary().keep_inside(plugin.scene(), position, images);
  EXPECT_EQ(position[0], 0.25);
  EXPECT_EQ(position[1], 0.5);
  EXPECT_EQ(images[0], 1);
  EXPECT_EQ(images[1], -1);
}

// Another periodic box finds the same neighbours: what is summed over them differs by rounding only.
TEST(TemplateName, FindsTheNeighboursOfAPeriodicBox) {
  const auto slope = [](const char* boundary) {
    PluginHarness plugin(PluginKind::boundary, boundary);
    plugin.set("f", {[](double x, double y) { return x * (1.0 - x) * y; }});
    return plugin.values("f_gradient", 1);
  };
  const auto found = slope("template_name");
  const auto expected = slope("periodic_wrap");
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-9) << "particle " << i;
}

}  // namespace
