#include <gtest/gtest.h>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

TEST(TemplateName, BringsAParticleBackIn) {
  PluginHarness plugin(PluginKind::boundary, "template_name");  // a box of 1 m
  double position[2] = {1.25, -0.25};
  std::int32_t images[2] = {0, 0};
  plugin.boundary().keep_inside(plugin.scene(), position, images);
  EXPECT_EQ(position[0], 0.25);
  EXPECT_EQ(position[1], 0.25) << "reflected by the wall";
  EXPECT_EQ(images[0], 1);
  EXPECT_EQ(images[1], 0);
}

// A fluid that moves along the walls everywhere is slower right at them: its second derivative across is negative.
TEST(TemplateName, HoldsTheFluidBack) {
  TestScene channel;
  channel.arrangement = "lattice";
  channel.more = "[physics.flow]\ntype = \"wcsph\"\ndensity = 1.0\nviscosity = 0.1";
  PluginHarness plugin(PluginKind::boundary, "template_name", "", channel);
  plugin.set("velocity", {1.0, 0.0});
  const auto y = plugin.position(1);
  const auto bend = plugin.values("velocity_laplacian", 0);
  for (std::size_t i = 0; i < y.size(); ++i) {
    if (y[i] < plugin.scene().spacing) {
      EXPECT_LT(bend[i], -1.0);
    } else if (y[i] > 0.45 && y[i] < 0.55) {
      EXPECT_NEAR(bend[i], 0.0, 1e-6);
    }
  }
}

}  // namespace
