#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

TEST(TemplateName, IsAShearWave) {
  PluginHarness plugin(PluginKind::initial, "template_name", "speed = 0.5");
  const auto u = plugin.values("velocity", 0);
  const auto v = plugin.values("velocity", 1);
  const auto y = plugin.position(1);  // in a box of 1 m
  for (std::size_t i = 0; i < u.size(); ++i) {
    EXPECT_NEAR(u[i], 0.5 * std::sin(2.0 * std::numbers::pi * y[i]), 1e-12);
    EXPECT_EQ(v[i], 0.0);
  }
}

// A run with a flow starts from it: the viscosity makes it slower.
TEST(TemplateName, IsWhereARunStarts) {
  TestScene scene;
  scene.arrangement = "lattice";
  scene.more = R"([physics.flow]
type = "wcsph"
density = 1.0
viscosity = 0.1)";
  PluginHarness plugin(PluginKind::initial, "template_name", "speed = 0.5", scene);
  plugin.set("compression", {0.0});
  const auto largest = [&] {
    double most = 0.0;
    for (const double u : plugin.values("velocity", 0)) most = std::max(most, std::abs(u));
    return most;
  };
  const double start = largest();
  plugin.run_until(0.1);
  // exp(-nu k^2 t)
  EXPECT_NEAR(largest() / start, std::exp(-0.1 * 4.0 * std::numbers::pi * std::numbers::pi * 0.1), 0.02);
}

}  // namespace
