#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

constexpr double pi = std::numbers::pi;

PluginHarness director(const std::string& keys, const TestScene& scene = {}) {
  return {PluginKind::initial, "director", keys, scene};
}

TEST(Director, IsUniformAtAnAngleInDegrees) {
  PluginHarness plugin = director("type = \"uniform\"\nangle = 30.0\norder = 0.8");
  for (const double q11 : plugin.values("order_tensor", 0)) EXPECT_NEAR(q11, 0.8 * 0.5, 1e-15);
  for (const double q12 : plugin.values("order_tensor", 1)) EXPECT_NEAR(q12, 0.8 * std::sqrt(0.75), 1e-15);
  EXPECT_NEAR(plugin.scene().constant("initial_director_angle"), pi / 6.0, 1e-15);
}

TEST(Director, AddsWaves) {
  TestScene scene;
  scene.length = 4.0;
  PluginHarness plugin =
      director("type = \"modes\"\nangle = 9.0\nmodes = [[1, 0, 0.05, 0.3], [2, -1, 0.02, 0.7]]", scene);
  const auto x = plugin.position(0);
  const auto y = plugin.position(1);
  const auto q11 = plugin.values("order_tensor", 0);
  const auto q12 = plugin.values("order_tensor", 1);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double angle =
        0.05 * pi + 0.05 * std::cos(2 * pi * x[i] / 4 + 0.3) + 0.02 * std::cos(2 * pi * (2 * x[i] - y[i]) / 4 + 0.7);
    EXPECT_NEAR(q11[i], std::cos(2 * angle), 1e-13);
    EXPECT_NEAR(q12[i], std::sin(2 * angle), 1e-13);
  }
}

TEST(Director, IsPerturbedBySeedAndParticle) {
  const std::string keys = "type = \"perturbed\"\namplitude = 0.2\n";
  TestScene scene;
  scene.across = 32;
  const auto angles = [&](const std::string& more) {
    PluginHarness plugin = director(keys + more, scene);
    auto angle = plugin.values("order_tensor", 1);
    for (double& q12 : angle) q12 = 0.5 * std::asin(q12);
    return angle;
  };
  const auto first = angles("");
  EXPECT_EQ(first, angles("seed = 1"));
  EXPECT_NE(first, angles("seed = 5"));
  double largest = 0.0;
  double mean = 0.0;
  for (const double angle : first) {
    largest = std::max(largest, std::abs(angle));
    mean += angle / static_cast<double>(first.size());
  }
  EXPECT_LE(largest, 0.2 + 1e-12);
  EXPECT_GT(largest, 0.19);
  EXPECT_NEAR(mean, 0.0, 0.015);
}

std::string refusal(const std::string& keys, const TestScene& scene = {}) {
  try {
    (void)director(keys, scene).scene();
  } catch (const Error& error) {
    const std::string text = error.what();
    return text.substr(std::min(text.size(), text.find(": director") + 2));
  }
  return "";
}

TEST(Director, RefusesAnAngleBeyondAFullTurn) {
  EXPECT_EQ(refusal("type = \"uniform\"\nangle = 400.0"),
            "director.angle: must be from -360 to 360 degree, but is 400.0");
}

TEST(Director, HasKeysOfItsTypeAlone) {
  EXPECT_EQ(refusal("type = \"uniform\"\nmodes = [[1, 0, 0.1, 0.0]]"),
            "director.modes: has a meaning only with type = \"modes\"");
  EXPECT_EQ(refusal("type = \"perturbed\""),
            "director.amplitude: must be given: a number in rad, >= 0 (largest random deviation of the angle)");
  EXPECT_EQ(refusal("type = \"mode\"\nmodes = [[1, 0, 0.1, 0.0]]"),
            "director.type: must be one of: uniform, perturbed, modes, defects, but is \"mode\"; did you mean "
            "\"modes\"?")
      << "nothing is known of keys while the type is wrong";
}

TEST(Director, RefusesWavesAndDefectsThatDoNotFitTheBox) {
  const std::string defects = "type = \"defects\"\ndefects = ";
  EXPECT_EQ(refusal("type = \"modes\"\nmodes = [[1.5, 0, 0.1, 0.0]]"),
            "director.modes: row 1: wave numbers must be whole, so that the wave fits the box, but one is 1.5");
  EXPECT_EQ(refusal(defects + "[[0.2, 0.2, 1.0]]"),
            "director.defects: row 1: the charge must be 0.5 or -0.5, but is 1");
  EXPECT_EQ(refusal(defects + "[[0.2, 0.2, 0.5], [0.7, 0.2, 0.5]]"),
            "director.defects: the charges must add up to 0 in a periodic box, but their sum is 1");
  EXPECT_EQ(refusal(defects + "[[0.2, 0.2, 0.5], [1.2, 0.2, -0.5]]"),
            "director.defects: rows 1 and 2 are at the same place");
  TestScene channel;
  channel.boundary = "walls";
  EXPECT_EQ(refusal(defects + "[[0.2, 0.2, 0.5], [0.7, 1.2, -0.5]]", channel),
            "director.defects: row 2: must lie in the box, y from 0 to 1 m, where this axis ends at walls, but is at "
            "1.2");
  EXPECT_EQ(
      refusal(defects + "[[0.2, 0.2, 0.5], [1e30, 0.2, -0.5]]"),
      "director.defects: row 2: must lie in the box, x from 0 to 1 m, or within 1e9 boxes of it, but is at 1e+30");
}

// Beyond a periodic face lies the other side of the box.
TEST(Director, FoldsDefectsIntoThePeriodicBox) {
  const auto tensor = [](const std::string& rows) {
    return director("type = \"defects\"\ndefects = " + rows).values("order_tensor", 1);
  };
  const auto inside = tensor("[[0.25, 0.5, 0.5], [0.75, 0.5, -0.5]]");
  const auto beyond = tensor("[[1.25, 0.5, 0.5], [-0.25, 2.5, -0.5]]");
  for (std::size_t i = 0; i < inside.size(); ++i) EXPECT_NEAR(inside[i], beyond[i], 1e-12);
}

// Without [director] a nematic does not know how it starts.
TEST(Director, IsAskedForWhereThereIsANematic) {
  try {
    (void)PluginHarness(R"([domain]
size = [1.0, 1.0]
boundary = "periodic_wrap"
[particles]
spacing = 0.05
[kernel]
type = "quintic"
[directer]
type = "uniform"
[physics.nematic]
type = "beris_edwards"
rotational_diffusivity = 1.0
flow_alignment = 0.7
elastic_constant = 0.01
[time]
end = 1.0)")
        .scene();
    FAIL() << "not refused";
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("directer: unknown section or key; did you mean \"director\"?"), std::string::npos) << text;
    EXPECT_EQ(text.find("needs an initial condition"), std::string::npos) << "it was meant to be there:\n" << text;
  }
}

}  // namespace
