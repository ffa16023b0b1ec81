#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

/// As it is usually written, 1 at the centre: 1 - 3/2 q^2 + 3/4 q^3 up to 1, (2 - q)^3 / 4 up to 2.
double textbook(double q) {
  if (q < 1.0) return 1.0 - 1.5 * q * q + 0.75 * q * q * q;
  return q < 2.0 ? std::pow(2.0 - q, 3) / 4.0 : 0.0;
}

TEST(CubicSpline, IsTheOneOfTheTextbooks) {
  PluginHarness plugin(PluginKind::kernel, "cubic_spline");
  const auto shape = plugin.kernel().shape();
  EXPECT_EQ(shape.support(), 2.0);
  for (int n = 0; n <= 250; ++n) {
    const double q = 0.01 * n;
    EXPECT_NEAR(shape.value(q) / shape.value(0.0), textbook(q), 1e-15) << "q = " << q;
  }
  EXPECT_NEAR(shape.normalisation(1) * 4.0, 2.0 / 3.0, 1e-14);
  EXPECT_NEAR(shape.normalisation(2) * 4.0, 10.0 / (7.0 * std::numbers::pi), 1e-14);
  EXPECT_NEAR(shape.normalisation(3) * 4.0, 1.0 / std::numbers::pi, 1e-14);
}

// Gradients are corrected, so they are exact for linear fields with this kernel as with any other.
TEST(CubicSpline, DifferentiatesLinearFieldsExactly) {
  TestScene scene;
  PluginHarness plugin(PluginKind::kernel, "cubic_spline", "", scene);
  plugin.set("f", {[](double x, double y) { return 3.0 * x - 2.0 * y; }});
  const auto x = plugin.position(0);
  const auto y = plugin.position(1);
  const auto slope = plugin.values("f_gradient", 0);
  int inside = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (std::min({x[i], y[i], 1.0 - x[i], 1.0 - y[i]}) < 0.15) continue;  // the field jumps at the faces
    EXPECT_NEAR(slope[i], 3.0, 1e-11);
    ++inside;
  }
  EXPECT_GT(inside, 100);
}

}  // namespace
