#include <gtest/gtest.h>

#include <cmath>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

// The scene is a periodic box with edges of 1.
TEST(SoluteSpots, AreRoundAndGoOnBehindAPeriodicFace) {
  PluginHarness plugin(PluginKind::initial, "solute_spots", "background = 0.2\nspots = [[0.0, 0.5, 0.1, 1.5]]");
  const auto x = plugin.position(0);
  const auto y = plugin.position(1);
  const auto solute = plugin.values("solute");
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double from_centre = std::min(x[i], 1.0 - x[i]);
    const double square = from_centre * from_centre + (y[i] - 0.5) * (y[i] - 0.5);
    EXPECT_NEAR(solute[i], 0.2 + 1.5 * std::exp(-square / 0.01), 1e-12);
  }
}

TEST(SoluteSpots, NeedARadius) {
  PluginHarness plugin(PluginKind::initial, "solute_spots", "spots = [[0.5, 0.5, 0.0, 1.0]]");
  try {
    (void)plugin.scene();
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_NE(
        std::string(error.what()).find("solute_spots.spots: the radius of a spot, its third number, must be above 0"),
        std::string::npos)
        << error.what();
  }
}

}  // namespace
