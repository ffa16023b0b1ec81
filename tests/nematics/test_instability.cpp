// Growth rates of waves in an active nematic, against eigenvalues and limits known in closed form.

#include "mesogen/nematics/instability.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace mesogen;
using namespace mesogen::nematics;

constexpr double longest = 2.0 * std::numbers::pi / 10.0;  // the longest wave in a box of 10 m

/// The deterministic benchmark.
ActiveFluid benchmark() { return {1.0, 2.0 / 3.0, 0.0, 0.05, 0.02, 0.4, 0.7, 1.0, false}; }

ActiveFluid paper() {
  ActiveFluid fluid = benchmark();
  fluid.activity = 0.023;
  return fluid;
}

/// As its plugins publish it.
Constants published(const ActiveFluid& fluid) {
  return {{"density", fluid.density},
          {"viscosity", fluid.viscosity},
          {"activity", fluid.activity},
          {"elastic_constant", fluid.elastic_constant},
          {"rotational_diffusivity", fluid.rotational_diffusivity},
          {"flow_alignment", fluid.flow_alignment},
          {"bulk_A", -1.0},
          {"bulk_C", 0.5}};
}

// The matrix ((-0.00315827, 0.675), (0.0394784, -0.263189)) has the eigenvalues 0.0755173 and -0.341865.
TEST(Instability, GrowthRateIsTheLargerEigenvalue) {
  EXPECT_NEAR(growth_rate(benchmark(), longest, 1.0), 0.0755173, 1e-7);
}

// Without inertia zeta (2 q + lambda) / (2 mu) - Gamma K k^2; with light fluid the eigenvalue comes there.
TEST(Instability, LightFluidGrowsAsOneWithoutInertia) {
  ActiveFluid fluid = benchmark();
  const double stokes = 0.05 * 2.7 / (2.0 * fluid.viscosity) - 0.4 * 0.02 * longest * longest;
  fluid.density = 1e-6;
  EXPECT_NEAR(fastest_wave(fluid, {10.0, 10.0, 0.0}, 0.0).without_inertia, stokes, 1e-12);
  EXPECT_NEAR(growth_rate(fluid, longest, 1.0), stokes, 1e-5 * stokes);
}

TEST(Instability, SplayOfAContractileFluidGrowsSlower) {
  ActiveFluid fluid = benchmark();
  fluid.activity = -0.05;
  fluid.density = 1e-9;
  EXPECT_NEAR(growth_rate(fluid, longest, -1.0), 0.05 * 1.3 / (2.0 * fluid.viscosity) - 0.4 * 0.02 * longest * longest,
              1e-9);
  EXPECT_LT(growth_rate(fluid, longest, 1.0), 0.0) << "its bend decays";
}

TEST(Instability, WithoutActivityWavesRelax) {
  ActiveFluid fluid = benchmark();
  fluid.activity = 0.0;
  EXPECT_NEAR(growth_rate(fluid, longest, 1.0), -0.4 * 0.02 * longest * longest, 1e-12);
}

// With the elastic stress the paper's fluid is only just unstable: K k^2 (2 Gamma mu / X + X) = 0.0229 Pa, X = 2.7,
// where without it 0.0016 Pa would do.
TEST(Instability, ThresholdOfThePapersFluid) {
  ActiveFluid fluid = paper();
  fluid.activity = 0.0016;
  EXPECT_GT(growth_rate(fluid, longest, 1.0), 0.0);
  fluid.activity = 0.0015;
  EXPECT_LT(growth_rate(fluid, longest, 1.0), 0.0);
  fluid.elastic_stress = true;
  fluid.activity = 0.0230;
  EXPECT_GT(growth_rate(fluid, longest, 1.0), 0.0);
  fluid.activity = 0.0228;
  EXPECT_LT(growth_rate(fluid, longest, 1.0), 0.0);
}

TEST(Instability, FrictionSlowsTheFlow) {
  ActiveFluid fluid = benchmark();
  fluid.friction = 3.0;
  const double rate = growth_rate(fluid, longest, 1.0);
  EXPECT_LT(rate, 0.0755173);
  // (s + Gamma K k^2) (rho s + mu k^2 + xi) = zeta k^2 (2 q + lambda) / 2
  const double k2 = longest * longest;
  EXPECT_NEAR((rate + 0.008 * k2) * (rate + 2.0 / 3.0 * k2 + 3.0), 0.05 * k2 * 1.35, 1e-12);
}

TEST(Instability, LongestBendOfAnExtensileFluidIsTheFastest) {
  for (const auto& [angle, mode] :
       {std::pair{0.0, std::array{1, 0}}, std::pair{std::numbers::pi / 2, std::array{0, 1}}}) {
    const Wave wave = fastest_wave(paper(), {10.0, 10.0, 0.0}, angle);
    EXPECT_NEAR(wave.growth_rate, growth_rate(paper(), longest, 1.0), 1e-15);
    EXPECT_NEAR(wave.growth_rate, 0.0376, 0.0001) << "the paper's case says 0.038 1/s";
    EXPECT_DOUBLE_EQ(wave.length, 10.0);
    EXPECT_EQ(wave.mode, mode);
    EXPECT_NEAR(wave.cosine, 1.0, 1e-12);
  }
}

// Inertia holds the longest wave back, so the best is the diagonal one, for a director that lies along it.
TEST(Instability, WithAnyDirectorTheDiagonalWaveIsFaster) {
  const Wave free = fastest_wave(benchmark(), {10.0, 10.0, 0.0});
  EXPECT_NEAR(free.length, 10.0 / std::numbers::sqrt2, 1e-12);
  EXPECT_GT(free.growth_rate, 0.08);
  const Wave along = fastest_wave(benchmark(), {10.0, 10.0, 0.0}, -std::numbers::pi / 4);
  EXPECT_NEAR(along.growth_rate, free.growth_rate, 1e-12);
  EXPECT_EQ(along.mode, (std::array{-1, 1}));
}

TEST(Instability, OfTheBenchmarkTheSecondWaveIsTheFastest) {
  const Wave wave = fastest_wave(benchmark(), {10.0, 10.0, 0.0}, 0.0);
  EXPECT_EQ(wave.mode, (std::array{2, 0}));
  EXPECT_NEAR(wave.growth_rate, 0.0813539, 1e-7);
}

// In a large box inertia holds the longest waves back.
TEST(Instability, InALargeBoxAShorterWaveIsTheFastest) {
  const Wave wave = fastest_wave(benchmark(), {200.0, 200.0, 0.0});
  EXPECT_LT(wave.length, 50.0);
  EXPECT_GT(wave.growth_rate, growth_rate(benchmark(), longest / 20.0, 1.0));
  const double k = 2.0 * std::numbers::pi / wave.length;
  for (const double other : {0.8 * k, 1.25 * k})
    EXPECT_LT(growth_rate(benchmark(), other, 1.0), wave.growth_rate * 1.001);
}

// With lambda > 2 q a contractile fluid grows fastest between bend and splay: no angle does better.
TEST(Instability, FastestAngleIsFound) {
  ActiveFluid fluid = benchmark();
  fluid.activity = -0.05;
  fluid.flow_alignment = 3.0;
  const Wave wave = fastest_wave(fluid, {10.0, 10.0, 0.0});
  EXPECT_NEAR(wave.cosine, -1.0 / 3.0, 1e-12);
  for (double c = -1.0; c <= 1.0; c += 0.01) EXPECT_LE(growth_rate(fluid, longest, c), wave.growth_rate + 1e-15) << c;
}

TEST(Instability, NeedsAllOfTheConstantsAndAnOrder) {
  EXPECT_TRUE(active_fluid(published(benchmark())));
  for (const char* missing : {"density", "viscosity", "activity", "elastic_constant", "bulk_A"}) {
    Constants constants = published(benchmark());
    constants.erase(missing);
    EXPECT_FALSE(active_fluid(constants)) << missing;
  }
  Constants isotropic = published(benchmark());
  isotropic["bulk_A"] = 0.2;
  EXPECT_FALSE(active_fluid(isotropic));
}

}  // namespace
