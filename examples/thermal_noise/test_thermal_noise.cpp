#include <gtest/gtest.h>

#include <omp.h>

#include <cmath>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

constexpr double temperature = 1e-5;
constexpr double stiffness = 2.0;  // A, Pa: above 0, so Q = 0 is the minimum
constexpr int across = 32;

/// An isotropic fluid at rest whose particles do not feel each other: K = 0.
PluginHarness bath(const std::string& more = "") {
  TestScene scene;
  scene.across = across;
  scene.arrangement = "lattice";
  scene.step = 0.01;
  scene.more = R"([physics.nematic]
type = "beris_edwards"
rotational_diffusivity = 1.0
flow_alignment = 0.0
elastic_constant = 0.0
bulk = { A = 2.0, C = 0.0 })";
  PluginHarness plugin(PluginKind::physics, "thermal_noise", "temperature = 1e-5\n" + more, scene);
  plugin.set("order_tensor", {0.0, 0.0});
  return plugin;
}

double mean_square(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return sum / static_cast<double>(values.size());
}

// Equipartition: <A V Q11^2> = kT / 2. 1024 particles over 20 independent times give 1 %; a step of 0.01 s adds
// Gamma A dt / 2 = 1 %.
TEST(ThermalNoise, GivesEachComponentHalfKT) {
  PluginHarness plugin = bath();
  double squares[2] = {0.0, 0.0};
  double product = 0.0;
  constexpr int times = 20;
  for (int n = 1; n <= times; ++n) {
    plugin.run_until(2.0 * n);
    const auto q11 = plugin.values("order_tensor", 0);
    const auto q12 = plugin.values("order_tensor", 1);
    squares[0] += mean_square(q11) / times;
    squares[1] += mean_square(q12) / times;
    for (std::size_t i = 0; i < q11.size(); ++i) product += q11[i] * q12[i] / (times * static_cast<double>(q11.size()));
  }
  const double expected = temperature * across * across / (2.0 * stiffness);
  EXPECT_NEAR(squares[0] / expected, 1.0, 0.05);
  EXPECT_NEAR(squares[1] / expected, 1.0, 0.05);
  EXPECT_NEAR(product / expected, 0.0, 0.03) << "the components are independent";
}

TEST(ThermalNoise, IsTheSameForAnyNumberOfThreads) {
  const auto after = [](int threads) {
    omp_set_num_threads(threads);
    PluginHarness plugin = bath();
    plugin.step(20);
    return plugin.values("order_tensor", 0);
  };
  const auto expected = after(1);
  EXPECT_GT(mean_square(expected), 0.0);
  EXPECT_EQ(after(3), expected);
  omp_set_num_threads(1);
}

TEST(ThermalNoise, DependsOnTheSeed) {
  PluginHarness one = bath("seed = 1");
  PluginHarness other = bath("seed = 2");
  one.step(3);
  other.step(3);
  EXPECT_NE(one.values("order_tensor", 0), other.values("order_tensor", 0));
}

TEST(ThermalNoise, AsksForANematic) {
  try {
    PluginHarness(PluginKind::physics, "thermal_noise", "temperature = 1e-5").start();
    FAIL() << "was accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what())
                  .find("thermal_noise needs the rotational diffusivity of a nematic: add a "
                        "[physics.*] section with type = \"beris_edwards\""),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
