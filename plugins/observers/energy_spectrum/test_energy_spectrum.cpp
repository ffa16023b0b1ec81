#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

constexpr double two_pi = 2.0 * std::numbers::pi;

struct Row {
  double k, energy, modes;
};

std::vector<Row> rows_of(PluginHarness& harness) {
  const auto values = harness.sample().at("spectrum");
  std::vector<Row> rows;
  for (std::size_t n = 0; n + 2 < values.size(); n += 3) rows.push_back({values[n], values[n + 1], values[n + 2]});
  return rows;
}

TestScene scene_of(int across, const std::string& arrangement = "jittered") {
  TestScene scene;
  scene.length = 2.0;
  scene.across = across;
  scene.arrangement = arrangement;
  return scene;
}

// u = (sin(k y), 0) has the energy 1/4, all of it at its own k.
TEST(EnergySpectrum, AWaveIsFoundAtItsOwnWaveNumber) {
  for (const int waves : {1, 3, 6}) {
    PluginHarness harness(PluginKind::observer, "energy_spectrum", "", scene_of(48));
    const double k = two_pi * waves / 2.0;
    harness.set("velocity", {[k](double, double y) { return std::sin(k * y); }, [](double, double) { return 0.0; }});
    const auto rows = rows_of(harness);
    ASSERT_GT(rows.size(), 9U);
    for (std::size_t n = 0; n < rows.size(); ++n) {
      const double expected = static_cast<int>(n) + 1 == waves ? 0.25 / (two_pi / 2.0) : 0.0;
      EXPECT_NEAR(rows[n].energy, expected, 1e-3 * 0.25 / (two_pi / 2.0)) << "shell " << n + 1;
    }
    const auto sample = harness.sample();
    EXPECT_NEAR(sample.at("energy").front(), 0.25, 2e-4);
    EXPECT_NEAR(sample.at("mean_wave_number").front() / k, 1.0, 0.01);
  }
}

TEST(EnergySpectrum, ShellsHoldTheModesOfTheirArea) {
  PluginHarness harness(PluginKind::observer, "energy_spectrum", "", scene_of(48, "lattice"));
  harness.set("velocity", {1.0, 0.0});
  const auto rows = rows_of(harness);
  // |k| L / 2 pi = 1, sqrt(2): all eight about the origin.
  EXPECT_EQ(rows[0].modes, 8.0);
  EXPECT_NEAR(rows[0].k, std::numbers::pi * (4.0 + 4.0 * std::numbers::sqrt2) / 8.0, 1e-12);
  for (const Row& row : rows) EXPECT_NEAR(row.energy, 0.0, 1e-20) << "the mean velocity is in no shell";
}

// The spectrum goes to ten waves along an edge here: a mesh of 32 points of which two thirds of the modes are kept.
TEST(EnergySpectrum, TellsTheShareOfTheEnergyBeyondIt) {
  const double k = two_pi / 2.0;
  struct {
    double along, across, amplitude, share, tolerance;
  } const waves[] = {
      {0.0, 3.0, 0.0, 0.0, 1e-6},         // nothing is beyond
      {0.0, 5.0, 0.5, 0.0, 1e-5},         // nor is a second wave within
      {0.0, 20.0, 0.5, 0.2, 1e-3},        // 0.5^2 / (1 + 0.5^2): a wave too short for the mesh
      {0.0, 20.0, 0.1, 1.0 / 101, 1e-4},  // one that hardly shows
      {9.0, 9.0, 0.5, 0.2, 1e-3},         // in a corner of the modes, where no shell is whole
  };
  for (const auto& wave : waves) {
    PluginHarness harness(PluginKind::observer, "energy_spectrum", "", scene_of(48, "lattice"));
    harness.set("velocity", {[&](double x, double y) {
                               return 3.0 + std::sin(k * y) +
                                      wave.amplitude * std::sin(k * (wave.along * x + wave.across * y));
                             },
                             [](double, double) { return 0.0; }});
    EXPECT_NEAR(harness.sample().at("energy_beyond").front(), wave.share, wave.tolerance)
        << wave.along << ", " << wave.across;
  }
}

// Noise from particle to particle is in all modes alike: those of the spectrum hold their share of it.
TEST(EnergySpectrum, OfNoiseMostIsBeyond) {
  PluginHarness harness(PluginKind::observer, "energy_spectrum", "", scene_of(48, "lattice"));
  std::mt19937_64 random(3);
  const auto noise = [&](double, double) { return std::generate_canonical<double, 53>(random) - 0.5; };
  harness.set("velocity", {noise, noise});
  double modes = 0.0;
  for (const Row& row : rows_of(harness)) modes += row.modes;
  EXPECT_NEAR(harness.sample().at("energy_beyond").front(), 1.0 - modes / (48.0 * 48.0), 0.02);
}

TEST(EnergySpectrum, OfAFluidThatMovesAsAWholeNoShareIsTold) {
  PluginHarness harness(PluginKind::observer, "energy_spectrum", "", scene_of(20, "lattice"));
  harness.set("velocity", {0.1, 0.0});
  EXPECT_TRUE(std::isnan(harness.sample().at("energy_beyond").front()));
}

/// A solenoidal velocity with E(k) ~ k^-4 up to the n-th wave along an axis, with random phases.
struct Field {
  std::vector<std::array<double, 4>> waves;  // k_x, k_y, amplitude of the velocity, phase

  explicit Field(int highest) {
    std::mt19937_64 random(11);
    for (int a = -highest; a <= highest; ++a)
      for (int b = 0; b <= highest; ++b) {
        if (b == 0 && a <= 0) continue;
        const double k = std::hypot(a, b) * two_pi / 2.0;
        // E dk = (ring of modes ~ k) |u_k|^2
        waves.push_back({a * two_pi / 2.0, b * two_pi / 2.0, std::pow(k, -2.5),
                         two_pi * std::generate_canonical<double, 53>(random)});
      }
  }
  [[nodiscard]] double value(int component, double x, double y) const {
    double sum = 0.0;
    for (const auto& [kx, ky, amplitude, phase] : waves) {
      const double across = (component == 0 ? -ky : kx) / std::hypot(kx, ky);
      sum += amplitude * across * std::cos(kx * x + ky * y + phase);
    }
    return sum;
  }
};

TEST(EnergySpectrum, ASlopeIsFound) {
  for (const char* const arrangement : {"lattice", "jittered"}) {
    PluginHarness harness(PluginKind::observer, "energy_spectrum", "slopes = [[6.0, 30.0], [12.0, 30.0]]",
                          scene_of(64, arrangement));
    const Field field(14);
    harness.set("velocity", {[&](double x, double y) { return field.value(0, x, y); },
                             [&](double x, double y) { return field.value(1, x, y); }});
    const auto slopes = harness.sample().at("slopes");
    ASSERT_EQ(slopes.size(), 8U);
    EXPECT_EQ(slopes[0], 6.0);
    EXPECT_EQ(slopes[1], 30.0);
    EXPECT_NEAR(slopes[2], -4.0, 0.01) << arrangement;
    EXPECT_NEAR(slopes[6], -4.0, 0.01) << arrangement;
    EXPECT_LT(slopes[3], 0.01);
    EXPECT_GT(slopes[3], 0.0);
  }
}

TEST(EnergySpectrum, RangesThatCannotBeAreRefused) {
  PluginHarness harness(PluginKind::observer, "energy_spectrum", "slopes = [[6.0, 5.0]]", scene_of(20));
  try {
    harness.sample();
    FAIL() << "a range from 6 to 5";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("slopes: a range must go from a wave number to a larger one"),
              std::string::npos)
        << error.what();
  }
}

TEST(EnergySpectrum, WallsAreRefused) {
  TestScene scene = scene_of(20);
  scene.boundary = "walls";
  PluginHarness harness(PluginKind::observer, "energy_spectrum", "", scene);
  try {
    harness.sample();
    FAIL() << "a spectrum between walls";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what())
                  .find("a spectrum exists only for periodic fields, and this box has walls: remove this observer"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
