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

// On a lattice every centre finds the same number of others: 400 particles, of which 150 or all are centres.
TEST(StructureFunction, LooksAroundAsManyParticlesAsItIsTold) {
  const auto pairs = [](const char* keys) {
    TestScene scene;
    scene.arrangement = "lattice";
    PluginHarness plugin(PluginKind::observer, "structure_function", keys, scene);
    plugin.set("velocity", {1.0, 0.0});
    return plugin.sample().at("structure_function").at(3);
  };
  const double one = pairs("bins = 1\nlargest = 0.12\ncentres = 1");
  EXPECT_EQ(one, 20.0);  // (1,0) (1,1) (2,0) (2,1) and their images, within 2.4 spacings
  EXPECT_EQ(pairs("bins = 1\nlargest = 0.12\ncentres = 150"), 150.0 * one);
  EXPECT_EQ(pairs("bins = 1\nlargest = 0.12\ncentres = 1000"), 400.0 * one);
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
