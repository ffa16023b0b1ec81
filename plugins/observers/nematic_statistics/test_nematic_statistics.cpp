#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/testing/plugin_harness.hpp"

namespace mesogen::testing {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double length = 3.0;
constexpr double k = 2.0 * pi / length;
constexpr double bulk_a = -0.7;
constexpr double bulk_c = 0.4;
constexpr double elastic_constant = 0.02;

using Function = PluginHarness::Function;
using Constants = std::map<std::string, double>;

const Constants nematic{{"bulk_A", bulk_a}, {"bulk_C", bulk_c}, {"elastic_constant", elastic_constant}};

void set_director(PluginHarness& context, const Function& order, const Function& angle) {
  context.set("order_tensor", {[=](double x, double y) { return order(x, y) * std::cos(2.0 * angle(x, y)); },
                               [=](double x, double y) { return order(x, y) * std::sin(2.0 * angle(x, y)); }});
}

PluginHarness uniform(double order, double angle, const Constants& constants = nematic) {
  TestScene scene;
  scene.length = length;
  scene.across = 30;
  scene.arrangement = "lattice";
  scene.constants = constants;
  PluginHarness context(PluginKind::observer, "nematic_statistics", "", scene);
  set_director(
      context, [=](double, double) { return order; }, [=](double, double) { return angle; });
  context.set("order_tensor_gradient", {0.0, 0.0, 0.0, 0.0});
  return context;
}

/// Of the box; the kernel's volumes add up to 6e-6 more on a lattice.
constexpr double area = length * length;

double value(PluginHarness& context, const std::string& quantity) { return context.sample().at(quantity).at(0); }

TEST(NematicStatistics, UniformNematic) {
  auto context = uniform(0.8, 0.6);
  const auto values = context.sample();
  EXPECT_NEAR(values.at("mean_order")[0], 0.8, 1e-15);
  EXPECT_NEAR(values.at("minimum_order")[0], 0.8, 1e-15);
  EXPECT_NEAR(values.at("mean_director_angle")[0], 0.6, 1e-15);
  EXPECT_NEAR(values.at("free_energy")[0], area * (bulk_a * 0.64 + bulk_c * 0.64 * 0.64), 1e-14);
}

TEST(NematicStatistics, MeanOrderIsNotTheOrderOfTheMean) {
  auto context = uniform(1.0, 0.0);
  set_director(
      context, [](double x, double) { return x < 0.1 ? 0.1 : 0.9; }, [](double x, double) { return k * x; });
  EXPECT_NEAR(value(context, "mean_order"), (0.1 + 29 * 0.9) / 30, 1e-14);
  EXPECT_NEAR(value(context, "minimum_order"), 0.1, 1e-15);
}

TEST(NematicStatistics, MeanDirectorIsThatOfTheMeanTensor) {
  auto context = uniform(1.0, 0.0);
  // 80 and -80 degrees are 20 degrees apart, about the y axis.
  const double angle = 80.0 / 180.0 * pi;
  set_director(
      context, [](double, double) { return 1.0; }, [=](double x, double) { return x < length / 2 ? angle : -angle; });
  EXPECT_NEAR(std::abs(value(context, "mean_director_angle")), pi / 2, 1e-12);
}

TEST(NematicStatistics, MeanDirectorAngleIsAboveMinusHalfPi) {
  auto context = uniform(1.0, 0.0);
  context.set("order_tensor", {-1.0, -1e-30});
  EXPECT_DOUBLE_EQ(value(context, "mean_director_angle"), pi / 2);
  EXPECT_NEAR(uniform(1.0, -1.5).sample().at("mean_director_angle")[0], -1.5, 1e-14);
}

TEST(NematicStatistics, TiltIsMeasuredFromTheMeanDirector) {
  auto context = uniform(0.8, 1.3);
  EXPECT_NEAR(value(context, "tilt_rms"), 0.0, 1e-15);
  // 80 and -80 degrees: 10 degrees to either side of the y axis.
  const double angle = 80.0 / 180.0 * pi;
  set_director(
      context, [](double x, double) { return x < 1.0 ? 0.2 : 0.9; },
      [=](double, double y) { return y < length / 2 ? angle : -angle; });
  EXPECT_NEAR(value(context, "tilt_rms"), 10.0 / 180.0 * pi, 1e-12);
  // a wave of amplitude a: a / sqrt(2)
  set_director(
      context, [](double, double) { return 1.0; }, [](double x, double) { return 0.7 + 1e-6 * std::cos(k * x); });
  EXPECT_NEAR(value(context, "tilt_rms"), 1e-6 / std::sqrt(2.0), 1e-14);
}

TEST(NematicStatistics, ElasticEnergyOfATwist) {
  auto context = uniform(0.5, 0.0);
  set_director(
      context, [](double, double) { return 0.5; }, [](double, double y) { return k * y; });
  const auto zero = [](double, double) { return 0.0; };
  context.set("order_tensor_gradient", {zero, [](double, double y) { return -k * std::sin(2.0 * k * y); }, zero,
                                        [](double, double y) { return k * std::cos(2.0 * k * y); }});
  const double bulk = bulk_a * 0.25 + bulk_c * 0.0625;
  EXPECT_NEAR(value(context, "free_energy"), area * (bulk + elastic_constant * k * k),
              1e-13);  // 4 K k^2 q^2
}

/// Q11 = a cos kx + e cos ky, Q12 = b sin kx cos 2ky, with its gradient and Laplacian.
struct Modes {
  double a, b, e;
  static double wave12(double x, double y) { return std::sin(k * x) * std::cos(2 * k * y); }
  [[nodiscard]] double q11(double x, double y) const { return a * std::cos(k * x) + e * std::cos(k * y); }
  [[nodiscard]] double q12(double x, double y) const { return b * wave12(x, y); }
  [[nodiscard]] double laplacian11(double x, double y) const { return -k * k * q11(x, y); }
  [[nodiscard]] double laplacian12(double x, double y) const { return -5.0 * k * k * q12(x, y); }
  [[nodiscard]] double free_energy() const {
    auto context = uniform(1.0, 0.0);
    const Modes m = *this;
    context.set("order_tensor",
                {[m](double x, double y) { return m.q11(x, y); }, [m](double x, double y) { return m.q12(x, y); }});
    context.set("order_tensor_gradient",
                {[m](double x, double) { return -k * m.a * std::sin(k * x); },
                 [m](double, double y) { return -k * m.e * std::sin(k * y); },
                 [m](double x, double y) { return k * m.b * std::cos(k * x) * std::cos(2 * k * y); },
                 [m](double x, double y) { return -2 * k * m.b * std::sin(k * x) * std::sin(2 * k * y); }});
    return value(context, "free_energy");
  }
};

TEST(NematicStatistics, VariationOfTheFreeEnergyIsTheMolecularField) {
  const Modes modes{0.6, 0.8, -0.3};
  // H = -A Q - C Q Tr Q^2 + K lap Q, and dF = -integral of Tr(H dQ) = -2 integral of (H11 dQ11 + H12 dQ12).
  double by_a = 0.0;
  double by_b = 0.0;
  constexpr int n = 64;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const double x = length * i / n;
      const double y = length * j / n;
      const double q11 = modes.q11(x, y);
      const double q12 = modes.q12(x, y);
      const double trace = 2.0 * (q11 * q11 + q12 * q12);
      const double h11 = -bulk_a * q11 - bulk_c * q11 * trace + elastic_constant * modes.laplacian11(x, y);
      const double h12 = -bulk_a * q12 - bulk_c * q12 * trace + elastic_constant * modes.laplacian12(x, y);
      by_a -= 2.0 * h11 * std::cos(k * x) * area / (n * n);
      by_b -= 2.0 * h12 * Modes::wave12(x, y) * area / (n * n);
    }
  }
  constexpr double step = 1e-4;
  const double along_a =
      Modes{modes.a + step, modes.b, modes.e}.free_energy() - Modes{modes.a - step, modes.b, modes.e}.free_energy();
  const double along_b =
      Modes{modes.a, modes.b + step, modes.e}.free_energy() - Modes{modes.a, modes.b - step, modes.e}.free_energy();
  EXPECT_GT(std::abs(by_a), 0.1);
  EXPECT_GT(std::abs(by_b), 0.1);
  EXPECT_NEAR(along_a / (2 * step), by_a, 1e-6);
  EXPECT_NEAR(along_b / (2 * step), by_b, 1e-6);
}

TEST(NematicStatistics, TakesTheElasticEnergyOfTheNematicWhereThereIsOne) {
  auto context = uniform(0.8, 0.6);
  context.set("order_tensor_gradient", {1e9, 1e9, 1e9, 1e9});
  context.set("elastic_energy", {0.25});
  EXPECT_NEAR(value(context, "free_energy"), area * (bulk_a * 0.64 + bulk_c * 0.64 * 0.64 + 0.25), 1e-13);
}

TEST(NematicStatistics, FreeEnergyIsUnknownWithoutConstants) {
  auto context = uniform(1.0, 0.0, {{"bulk_A", bulk_a}, {"bulk_C", bulk_c}});
  EXPECT_TRUE(std::isnan(value(context, "free_energy")));
  EXPECT_NEAR(value(context, "mean_order"), 1.0, 1e-15);
}

TEST(NematicStatistics, OrderOfStorageDoesNotMatter) {
  auto context = uniform(1.0, 0.0);
  set_director(
      context, [](double x, double y) { return 0.5 + 0.1 * std::sin(3 * x + y); },
      [](double x, double y) { return x * y; });
  const auto before = context.sample();
  context.shuffle(8);
  EXPECT_EQ(context.sample(), before);
}

}  // namespace
}  // namespace mesogen::testing
