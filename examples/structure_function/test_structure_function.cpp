#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

// A shear wave u = U sin(k y), averaged over all places and directions, with z = k r:
// along the distance U^2 (1/2 - J1(z) / z), across it U^2 (1/2 - J0(z) + J1(z) / z).
TEST(StructureFunction, IsThatOfAShearWave) {
  constexpr double k = 2.0 * std::numbers::pi;
  TestScene scene;
  scene.across = 50;
  PluginHarness plugin(PluginKind::observer, "structure_function", "bins = 10\nlargest = 0.5\ncentres = 2500", scene);
  plugin.set("velocity", {[](double, double y) { return 2.0 * std::sin(k * y); }, [](double, double) { return 0.0; }});
  const auto rows = plugin.sample().at("structure_function");
  ASSERT_EQ(rows.size(), 40U);
  for (std::size_t bin = 0; bin < 10; ++bin) {
    const double* row = rows.data() + 4 * bin;
    const double z = k * row[0];
    const double longitudinal = 4.0 * (0.5 - std::cyl_bessel_j(1.0, z) / z);
    const double transverse = 4.0 * (0.5 - std::cyl_bessel_j(0.0, z) + std::cyl_bessel_j(1.0, z) / z);
    // The mean of r^2 in a bin is above the square of the mean r by a twelfth of the square of its width.
    const double tolerance = 0.03 + 0.05 * 0.05 / 12.0 / (row[0] * row[0]);
    EXPECT_NEAR(row[1] / longitudinal, 1.0, tolerance) << "r = " << row[0];
    EXPECT_NEAR(row[2] / transverse, 1.0, tolerance) << "r = " << row[0];
    EXPECT_GT(row[3], 0.0);
  }
}

TEST(StructureFunction, IsNothingInAUniformFlow) {
  PluginHarness plugin(PluginKind::observer, "structure_function", "bins = 4");
  plugin.set("velocity", {3.0, -1.0});
  const auto rows = plugin.sample().at("structure_function");
  for (std::size_t bin = 0; bin < 4; ++bin) {
    EXPECT_EQ(rows[4 * bin + 1], 0.0);
    EXPECT_EQ(rows[4 * bin + 2], 0.0);
  }
}

}  // namespace
