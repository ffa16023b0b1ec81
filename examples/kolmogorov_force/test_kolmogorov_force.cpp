#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

TEST(KolmogorovForce, IsASineAlongY) {
  PluginHarness plugin(PluginKind::physics, "kolmogorov_force", "amplitude = 0.6\nwaves = 2");
  plugin.set("density", {2.0});
  plugin.run("Kolmogorov force");
  const auto y = plugin.position(1);
  const auto push = plugin.values("acceleration", 0);
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(push[i], 0.3 * std::sin(4.0 * std::numbers::pi * y[i]), 1e-13);
}

// From rest: u = F / (mu k^2) (1 - exp(-nu k^2 t)) sin(k y).
TEST(KolmogorovForce, DrivesTheFlowThatStokesPredicts) {
  constexpr double amplitude = 1e-3;
  constexpr double viscosity = 0.1;
  constexpr double k = 2.0 * std::numbers::pi;
  TestScene scene;
  scene.arrangement = "lattice";
  scene.across = 32;
  scene.more = "[physics.flow]\ntype = \"wcsph\"\ndensity = 1.0\nviscosity = 0.1";
  PluginHarness plugin(PluginKind::physics, "kolmogorov_force", "amplitude = 1e-3", scene);
  plugin.set("velocity", {0.0, 0.0}).set("compression", {0.0});
  const double time = 1.0 / (viscosity * k * k);
  plugin.run_until(time);
  const auto y = plugin.position(1);
  const auto u = plugin.values("velocity", 0);
  double sine = 0.0;
  for (std::size_t i = 0; i < y.size(); ++i) sine += 2.0 * u[i] * std::sin(k * y[i]) / static_cast<double>(y.size());
  EXPECT_NEAR(sine / (amplitude / (viscosity * k * k) * (1.0 - std::exp(-1.0))), 1.0, 0.01);
}

}  // namespace
