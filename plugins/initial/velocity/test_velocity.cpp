#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

constexpr double pi = std::numbers::pi;

TEST(Velocity, RestsWhereItIsToldTo) {
  PluginHarness plugin(PluginKind::initial, "velocity", "type = \"rest\"");
  for (int c = 0; c < 2; ++c)
    for (const double u : plugin.values("velocity", c)) EXPECT_EQ(u, 0.0);
}

TEST(Velocity, IsUniform) {
  PluginHarness plugin(PluginKind::initial, "velocity", "type = \"uniform\"\nvalue = [0.5, -2.0]");
  for (const double u : plugin.values("velocity", 0)) EXPECT_EQ(u, 0.5);
  for (const double v : plugin.values("velocity", 1)) EXPECT_EQ(v, -2.0);
}

// u = (d psi / dy, -d psi / dx) of the sum of the waves, in a box of 4 m.
TEST(Velocity, FollowsTheStreamFunction) {
  TestScene scene;
  scene.length = 4.0;
  PluginHarness plugin(PluginKind::initial, "velocity",
                       "type = \"modes\"\nmodes = [[1, 2, 0.3, 0.4], [3, -1, 0.1, 1.0]]", scene);
  const auto psi = [](double x, double y) {
    return 0.3 * std::cos(2 * pi * (x + 2 * y) / 4 + 0.4) + 0.1 * std::cos(2 * pi * (3 * x - y) / 4 + 1.0);
  };
  const auto x = plugin.position(0);
  const auto y = plugin.position(1);
  const auto u = plugin.values("velocity", 0);
  const auto v = plugin.values("velocity", 1);
  const double e = 1e-5;
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_NEAR(u[i], (psi(x[i], y[i] + e) - psi(x[i], y[i] - e)) / (2 * e), 1e-8);
    EXPECT_NEAR(v[i], -(psi(x[i] + e, y[i]) - psi(x[i] - e, y[i])) / (2 * e), 1e-8);
  }
}

std::string refusal(const std::string& keys) {
  try {
    (void)PluginHarness(PluginKind::initial, "velocity", keys).scene();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Velocity, RefusesAWaveThatDoesNotFitTheBox) {
  EXPECT_EQ(refusal("type = \"modes\"\nmodes = [[1, 1, 0.1, 0.0], [1.5, 0, 0.1, 0.0]]"),
            "the test's case:15:9: velocity.modes: row 2: wave numbers must be whole, so that the wave fits the box, "
            "but one is 1.5");
}

TEST(Velocity, HasKeysOfItsTypeAlone) {
  EXPECT_EQ(refusal("type = \"rest\"\nvalue = [1.0, 0.0]"),
            "the test's case:15:9: velocity.value: has a meaning only with type = \"uniform\"");
  EXPECT_EQ(refusal("type = \"uniform\""),
            "the test's case:13:1: velocity.value: must be given: a list of 2 numbers in m/s (velocity everywhere)");
}

}  // namespace
