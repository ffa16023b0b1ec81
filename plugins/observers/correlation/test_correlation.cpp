#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "autocorrelation.hpp"
#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

constexpr double length = 2.0;  // m, edge of the box
constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double k1 = two_pi / length;

TestScene scene_of(int across, const std::string& arrangement) {
  TestScene scene;
  scene.length = length;
  scene.across = across;
  scene.arrangement = arrangement;
  return scene;
}

/// A table against what is known: at r, along the axes and over all directions.
void expect_table(const std::vector<double>& table, std::size_t rows, double step,
                  const std::function<double(double)>& along_axes, const std::function<double(double)>& radial,
                  double tolerance) {
  ASSERT_EQ(table.size(), 3 * rows);
  for (std::size_t n = 0; n < rows; ++n) {
    const double r = static_cast<double>(n) * step;
    EXPECT_NEAR(table[3 * n], r, 1e-12);
    EXPECT_NEAR(table[3 * n + 1], along_axes(r), tolerance) << "along the axes, r = " << r;
    EXPECT_NEAR(table[3 * n + 2], radial(r), tolerance) << "over all directions, r = " << r;
  }
}

/// Where a function that falls from 1 is at `level`, between 0 and `end`.
double falls_to(double level, const std::function<double(double)>& function, double end) {
  double above = 0.0;
  double below = end;
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (above + below);
    (function(middle) > level ? above : below) = middle;
  }
  return below;
}

// u = (cos kx sin ky, -sin kx cos ky): modes at (+-k, +-k), so cos(kr) along each axis and J0(sqrt(2) k r) radially.
TEST(Correlation, VorticesOfOneWaveNumberGiveCosineAndBesselFunction) {
  for (const char* const arrangement : {"lattice", "jittered"}) {
    for (const int waves : {1, 3}) {
      PluginHarness harness(PluginKind::observer, "correlation", "", scene_of(48, arrangement));
      const double k = waves * k1;
      harness.set("velocity", {[k](double x, double y) { return std::cos(k * x) * std::sin(k * y); },
                               [k](double x, double y) { return -std::sin(k * x) * std::cos(k * y); }});
      const auto sample = harness.sample();
      const double tolerance = std::string(arrangement) == "lattice" ? 1e-9 : 1e-4;
      const auto axes = [k](double r) { return std::cos(k * r); };
      const auto radial = [k](double r) { return std::cyl_bessel_j(0.0, std::numbers::sqrt2 * k * r); };
      for (const std::string field : {"velocity", "vorticity"}) {
        SCOPED_TRACE(field + " on " + arrangement);
        expect_table(sample.at(field), 25, length / 48, axes, radial, tolerance);
        EXPECT_NEAR(sample.at(field + "_zero_axes").front(), 0.25 * length / waves, tolerance);
        EXPECT_NEAR(sample.at(field + "_level_axes").front(), std::acos(0.2) / k, tolerance);
        EXPECT_NEAR(sample.at(field + "_zero_radial").front(), 2.404825557695773 / (std::numbers::sqrt2 * k),
                    tolerance);
        EXPECT_NEAR(sample.at(field + "_level_radial").front(), falls_to(0.2, radial, 0.3 * length / waves), tolerance);
      }
    }
  }
}

// A wave of 20 along the edge is too short for the mesh of 32 points: 0.5^2 / (1 + 0.5^2) of the whole.
TEST(Correlation, TellsTheShareOfTheVelocityBeyondItsModes) {
  for (const double amplitude : {0.0, 0.5}) {
    PluginHarness harness(PluginKind::observer, "correlation", "", scene_of(48, "lattice"));
    harness.set("velocity",
                {[amplitude](double, double y) { return 1.0 + std::sin(k1 * y) + amplitude * std::sin(20.0 * k1 * y); },
                 [](double, double) { return 0.0; }});
    EXPECT_NEAR(harness.sample().at("velocity_beyond").front(), amplitude > 0.0 ? 0.2 : 0.0, 1e-3);
  }
}

// u = (sin ky, 0) is the same all along x: (1 + cos kr) / 2 over both axes, which touches 0 where cos kr is -1.
TEST(Correlation, AxesAreAveraged) {
  PluginHarness harness(PluginKind::observer, "correlation", "separation_step = 0.03\nlevel = 0.5",
                        scene_of(40, "lattice"));
  harness.set("velocity",
              {[](double, double y) { return std::sin(2.0 * k1 * y); }, [](double, double) { return 0.0; }});
  const auto sample = harness.sample();
  const auto axes = [](double r) { return 0.5 + 0.5 * std::cos(2.0 * k1 * r); };
  const auto radial = [](double r) { return std::cyl_bessel_j(0.0, 2.0 * k1 * r); };
  expect_table(sample.at("velocity"), 34, 0.03, axes, radial, 1e-6);
  EXPECT_NEAR(sample.at("velocity_level_axes").front(), 0.125 * length, 1e-6);
  EXPECT_TRUE(std::isnan(sample.at("velocity_zero_axes").front())) << "the table passes by the point where C is 0";
  EXPECT_NEAR(sample.at("vorticity_level_radial").front(), falls_to(0.5, radial, 0.5), 1e-6);
}

/// A flow of random phases whose stream function has the spectrum exp(-k^2 s^2 / 2), and so the autocorrelation
/// exp(-r^2 / 2 s^2); that of the velocity is its Laplacian, that of the vorticity its bi-Laplacian.
struct Vortices {
  struct Wave {
    double kx, ky, amplitude, phase;
  };
  std::vector<Wave> waves;

  explicit Vortices(double size) {
    constexpr int highest = 11;
    std::mt19937_64 random(7);
    for (int a = -highest; a <= highest; ++a)
      for (int b = 0; b <= highest; ++b) {
        if (b == 0 && a <= 0) continue;
        const double square = (a * a + b * b) * k1 * k1;
        waves.push_back({a * k1, b * k1, std::exp(-0.25 * square * size * size),
                         two_pi * std::generate_canonical<double, 53>(random)});
      }
  }
  /// Component of the velocity (d psi/dy, -d psi/dx).
  [[nodiscard]] PluginHarness::Function velocity(int component, double mean = 0.0) const {
    return [this, component, mean](double x, double y) {
      double sum = mean;
      for (const auto& [kx, ky, amplitude, phase] : waves)
        sum -= (component == 0 ? ky : -kx) * amplitude * std::sin(kx * x + ky * y + phase);
      return sum;
    };
  }
};

TEST(Correlation, AGaussianSpectrumGivesItsKnownCorrelations) {
  constexpr double size = 0.2;
  const Vortices vortices(size);
  const auto velocity = [](double r) {
    const double x = r * r / (size * size);
    return (1.0 - 0.5 * x) * std::exp(-0.5 * x);
  };
  const auto vorticity = [](double r) {
    const double x = r * r / (size * size);
    return (1.0 - x + 0.125 * x * x) * std::exp(-0.5 * x);
  };
  for (const char* const arrangement : {"lattice", "jittered"}) {
    SCOPED_TRACE(arrangement);
    PluginHarness harness(PluginKind::observer, "correlation", "", scene_of(64, arrangement));
    harness.set("velocity", {vortices.velocity(0), vortices.velocity(1)});
    const auto sample = harness.sample();
    expect_table(sample.at("velocity"), 33, length / 64, velocity, velocity, 1e-3);
    expect_table(sample.at("vorticity"), 33, length / 64, vorticity, vorticity, 1e-3);
    for (const std::string along : {"axes", "radial"}) {
      EXPECT_NEAR(sample.at("velocity_zero_" + along).front(), std::numbers::sqrt2 * size, 1e-3 * size);
      EXPECT_NEAR(sample.at("vorticity_zero_" + along).front(), std::sqrt(4.0 - 2.0 * std::numbers::sqrt2) * size,
                  1e-3 * size);
      EXPECT_NEAR(sample.at("velocity_level_" + along).front(), falls_to(0.2, velocity, 1.4 * size), 1e-3 * size);
      EXPECT_NEAR(sample.at("vorticity_level_" + along).front(), falls_to(0.2, vorticity, 1.08 * size), 1e-3 * size);
    }
  }
}

TEST(Correlation, AFlowThatIsCarriedAlongIsTheSame) {
  const Vortices vortices(0.25);
  const auto sampled = [&](double u, double v) {
    PluginHarness harness(PluginKind::observer, "correlation", "", scene_of(48, "jittered"));
    harness.set("velocity", {vortices.velocity(0, u), vortices.velocity(1, v)});
    return harness.sample();
  };
  const auto at_rest = sampled(0.0, 0.0);
  const auto carried = sampled(30.0, -12.0);
  ASSERT_EQ(at_rest.size(), 11U);
  for (const auto& [quantity, values] : at_rest) {
    const auto& others = carried.at(quantity);
    ASSERT_EQ(values.size(), others.size());
    for (std::size_t n = 0; n < values.size(); ++n) EXPECT_NEAR(values[n], others[n], 1e-10) << quantity;
  }
}

TEST(Correlation, OfAFluidThatMovesAsAWholeThereIsNone) {
  for (const double speed : {0.0, 3.0}) {
    PluginHarness harness(PluginKind::observer, "correlation", "", scene_of(24, "jittered"));
    harness.set("velocity", {speed, -speed});
    for (const auto& [quantity, values] : harness.sample())
      for (std::size_t n = 0; n < values.size(); ++n)
        EXPECT_TRUE(std::isnan(values[n]) || (values.size() > 1 && n % 3 == 0)) << quantity << " at speed " << speed;
  }
}

// What the observer makes of three dimensions; there are no scenes of these yet.
TEST(Correlation, InThreeDimensionsAllDirectionsGiveTheSincFunction) {
  const mesh::Grid<3> grid{{8, 12, 10}, {1.0, 1.5, 2.0}};
  std::vector<double> power(grid.mode_count(), 0.0);
  power[0] = 5.0;                                                   // the mean
  power[2] = 1.0;                                                   // (2, 0, 0), and its mirror image
  power[static_cast<std::size_t>(grid.modes_in_row())] = 1.0;       // (0, 1, 0)
  power[static_cast<std::size_t>(grid.modes_in_row()) * 11] = 1.0;  // (0, -1, 0)
  const correlation::Autocorrelation<3> c(grid, power);
  const double a = 2.0 * two_pi;
  const double b = two_pi / 1.5;
  for (const double r : {0.1, 0.3, 0.5}) {
    EXPECT_NEAR(c.along_axes(r), (1.0 + (1.0 + std::cos(a * r)) / 2.0 + (1.0 + std::cos(b * r)) / 2.0) / 3.0, 1e-14);
    EXPECT_NEAR(c.radial(r), 0.5 * (std::sin(a * r) / (a * r) + std::sin(b * r) / (b * r)), 1e-14);
  }
  EXPECT_EQ(c.radial(0.0), 1.0);
}

/// What a case is refused with.
std::string refusal(const std::string& keys, const TestScene& scene) {
  try {
    PluginHarness(PluginKind::observer, "correlation", keys, scene).sample();
  } catch (const Error& error) {
    return error.code() == ExitCode::bad_case ? error.what() : "another exit code";
  }
  return "it was taken";
}

TEST(Correlation, SaysWhatIsWrong) {
  TestScene scene = scene_of(20, "lattice");
  EXPECT_NE(refusal("separation_step = 1.1", scene)
                .find("separation_step: must be at most half the shortest edge of the box, where the correlations end"),
            std::string::npos)
      << refusal("separation_step = 1.1", scene);
  scene.boundary = "walls";
  EXPECT_NE(refusal("", scene).find(
                "correlations exist only for periodic fields, and this box has walls: remove this observer"),
            std::string::npos)
      << refusal("", scene);
}

}  // namespace
