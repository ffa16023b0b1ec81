#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

TestScene channel(const std::string& more = "") {
  TestScene scene;
  scene.arrangement = "lattice";
  scene.boundary = "walls";
  scene.more = more;
  return scene;
}

TEST(HybridCell, TurnsLinearlyFromWallToWall) {
  PluginHarness plugin(PluginKind::initial, "hybrid_cell", "angle_low = 0.0\nangle_high = 90.0", channel());
  const auto y = plugin.position(1);
  const auto q11 = plugin.values("order_tensor", 0);
  const auto q12 = plugin.values("order_tensor", 1);
  for (std::size_t i = 0; i < y.size(); ++i) {
    EXPECT_NEAR(q11[i], std::cos(std::numbers::pi * y[i]), 1e-14);
    EXPECT_NEAR(q12[i], std::sin(std::numbers::pi * y[i]), 1e-14);
  }
}

TEST(HybridCell, MustFitAPeriodicBox) {
  TestScene periodic;
  PluginHarness fits(PluginKind::initial, "hybrid_cell", "angle_low = 10.0\nangle_high = 190.0", periodic);
  EXPECT_NO_THROW((void)fits.scene());
  PluginHarness torn(PluginKind::initial, "hybrid_cell", "angle_low = 0.0\nangle_high = 90.0", periodic);
  try {
    (void)torn.scene();
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("hybrid_cell.angle_high: must differ from angle_low by a multiple of 180"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
