#include <gtest/gtest.h>

#include <string>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

// f = -zeta (dQ11/dx + dQ12/dy, dQ12/dx - dQ11/dy) / rho, beside what others added
TEST(ActiveStress, AddsTheDivergenceOfItsStress) {
  for (const double zeta : {0.5, -0.5}) {
    PluginHarness active(PluginKind::physics, "active_stress", "activity = " + std::to_string(zeta));
    active.set("order_tensor_gradient", {1.0, 20.0, 300.0, 4000.0});  // Q11_x, Q11_y, Q12_x, Q12_y
    active.set("density", {2.0}).set("acceleration", {7.0, 8.0});
    active.run("active stress");
    EXPECT_DOUBLE_EQ(active.value("acceleration", 0), 7.0 - zeta * (1.0 + 4000.0) / 2.0);
    EXPECT_DOUBLE_EQ(active.value("acceleration", 1), 8.0 - zeta * (300.0 - 20.0) / 2.0);
  }
}

TEST(ActiveStress, PublishesItsStressScale) {
  PluginHarness active(PluginKind::physics, "active_stress", "activity = -0.3");
  Scene scene;
  scene.dimension = 2;
  scene.scales.stress = 0.1;
  active.physics().publish(scene);
  EXPECT_EQ(scene.scales.stress, 0.3);
  EXPECT_EQ(scene.constant("activity"), -0.3);
  scene.scales.stress = 1.0;
  active.physics().publish(scene);
  EXPECT_EQ(scene.scales.stress, 1.0) << "another's is larger";
}

TEST(ActiveStress, OfZeroAddsNothing) {
  PluginHarness active(PluginKind::physics, "active_stress", "activity = 0.0");
  active.set("order_tensor_gradient", {1.0, 20.0, 300.0, 4000.0}).set("density", {2.0});
  active.start();
  EXPECT_EQ(active.value("acceleration", 0), 0.0);
  EXPECT_EQ(active.value("acceleration", 1), 0.0);
}

}  // namespace
