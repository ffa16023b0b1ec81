#include <gtest/gtest.h>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

// One pass by itself, on given fields.
TEST(TemplateName, AddsForceOverDensity) {
  PluginHarness plugin(PluginKind::physics, "template_name", "force = 0.6");
  plugin.set("density", {2.0});
  plugin.run("template_name");
  EXPECT_DOUBLE_EQ(plugin.value("acceleration", 0), 0.3);
  EXPECT_EQ(plugin.value("acceleration", 1), 0.0);
}

// A run together with other plugins: nothing but the force acts on a fluid at rest, so u = F t / rho.
TEST(TemplateName, SpeedsUpAFluidAtRest) {
  TestScene scene;
  scene.arrangement = "lattice";
  scene.more = R"([physics.flow]
type = "wcsph"
density = 2.0
viscosity = 0.1)";
  PluginHarness plugin(PluginKind::physics, "template_name", "force = 0.6", scene);
  plugin.set("velocity", {0.0, 0.0}).set("compression", {0.0});
  plugin.run_until(0.1);
  EXPECT_NEAR(plugin.value("velocity", 0), 0.03, 1e-6);
}

}  // namespace
