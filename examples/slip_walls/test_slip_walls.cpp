#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

TestScene channel() {
  TestScene scene;
  scene.across = 32;
  scene.arrangement = "lattice";
  scene.more = "[physics.flow]\ntype = \"wcsph\"\ndensity = 1.0\nviscosity = 0.1";
  return scene;
}

TEST(SlipWalls, DoNotHoldAUniformFlowBack) {
  PluginHarness plugin(PluginKind::boundary, "slip_walls", "", channel());
  plugin.set("velocity", {0.01, 0.0}).set("compression", {0.0});
  plugin.run_until(0.2);
  for (const double u : plugin.values("velocity", 0)) EXPECT_NEAR(u, 0.01, 1e-10);
  for (const double v : plugin.values("velocity", 1)) EXPECT_NEAR(v, 0.0, 1e-10);
}

// u = U cos(pi y / H) has no slope at the walls and decays as exp(-nu (pi / H)^2 t).
TEST(SlipWalls, LetAShearFlowDecayAtTheExactRate) {
  constexpr double k = std::numbers::pi;
  PluginHarness plugin(PluginKind::boundary, "slip_walls", "", channel());
  plugin.set("velocity", {[](double, double y) { return 1e-4 * std::cos(k * y); }, [](double, double) { return 0.0; }});
  plugin.set("compression", {0.0});
  const auto amplitude = [&] {
    const auto y = plugin.position(1);
    const auto u = plugin.values("velocity", 0);
    double sum = 0.0;
    for (std::size_t i = 0; i < y.size(); ++i) sum += u[i] * std::cos(k * y[i]);
    return sum;
  };
  const double begun = amplitude();
  plugin.run_until(0.5);
  EXPECT_NEAR(std::log(begun / amplitude()) / (0.1 * k * k * 0.5), 1.0, 0.01);
}

TEST(SlipWalls, ReflectWhatPassedThem) {
  PluginHarness plugin(PluginKind::boundary, "slip_walls");
  double position[2] = {-0.25, 1.125};
  std::int32_t images[2] = {0, 0};
  plugin.boundary().keep_inside(plugin.scene(), position, images);
  EXPECT_EQ(position[0], 0.75);
  EXPECT_EQ(position[1], 0.875);
  EXPECT_EQ(images[0], -1);
}

}  // namespace
