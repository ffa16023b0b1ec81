#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "fake_observer_context.hpp"

namespace mesogen::test {
namespace {

constexpr double length = 2.0;
constexpr double speed = 0.3;
constexpr double k = 2.0 * std::numbers::pi / length;
constexpr double area = length * length;

/// Taylor-Green vortices: u = U sin kx cos ky, v = -U cos kx sin ky. On a lattice its averages are exact.
FakeObserverContext vortices(double drift_x = 0.0) {
  FakeObserverContext context(32, 32, length, length);
  const auto both = [](auto f, auto g, double factor) {
    return [=](double x, double y) { return factor * f(k * x) * g(k * y); };
  };
  const auto sine = [](double x) { return std::sin(x); };
  const auto cosine = [](double x) { return std::cos(x); };
  const auto u = both(sine, cosine, speed);
  context.set("velocity", {[=](double x, double y) { return drift_x + u(x, y); }, both(cosine, sine, -speed)});
  context.set("velocity_gradient", {both(cosine, cosine, speed * k), both(sine, sine, -speed * k),
                                    both(sine, sine, speed * k), both(cosine, cosine, -speed * k)});
  context.set("density", {[](double, double) { return 1.5; }});
  context.set("internal_energy", {both(sine, sine, 2.0)});
  return context;
}

ObserverUnderTest started(const FakeObserverContext& context) {
  ObserverUnderTest observer("flow_statistics");
  observer.start(context);
  return observer;
}

TEST(FlowStatistics, TaylorGreenVortices) {
  const auto context = vortices();
  const auto values = started(context).sample(context);
  EXPECT_NEAR(values.at("v_rms")[0], speed / std::sqrt(2.0), 1e-14);
  EXPECT_NEAR(values.at("vorticity_rms")[0], speed * k, 1e-13);
  EXPECT_NEAR(values.at("divergence_rms")[0], 0.0, 1e-14);
  EXPECT_NEAR(values.at("kinetic_energy")[0], 0.5 * 1.5 * area * speed * speed / 2.0, 1e-14);
  ASSERT_EQ(values.at("total_momentum").size(), 2U);
  EXPECT_NEAR(values.at("total_momentum")[0], 0.0, 1e-16);
  EXPECT_NEAR(values.at("total_momentum")[1], 0.0, 1e-16);
}

// A creeping flow is computed with an artificial density: mass and energy are those of the fluid all the same.
TEST(FlowStatistics, TellsThePhysicalDensity) {
  auto context = vortices();
  context.set_constant("density", 1.5);
  context.set_constant("physical_density", 3e-4);
  const auto values = started(context).sample(context);
  EXPECT_NEAR(values.at("kinetic_energy")[0] / (0.5 * 3e-4 * area * speed * speed / 2.0), 1.0, 1e-12);
  EXPECT_NEAR(values.at("density_min")[0], 3e-4, 1e-16);
  EXPECT_NEAR(values.at("density_max")[0], 3e-4, 1e-16);
}

TEST(FlowStatistics, EnergyOfCompressionIsThatOfVolumesAtRest) {
  auto context = vortices();
  context.set("internal_energy", {[](double x, double) { return 3.0 + std::sin(k * x); }});
  context.jitter(0.3, 4);
  EXPECT_NEAR(started(context).number(context, "compression_energy"), 3.0 * area, 1e-13);
}

TEST(FlowStatistics, MomentumOfADrift) {
  const auto context = vortices(0.25);
  const auto values = started(context).sample(context);
  EXPECT_NEAR(values.at("total_momentum")[0], 1.5 * area * 0.25, 1e-13);
  EXPECT_NEAR(values.at("total_momentum")[1], 0.0, 1e-16);
  EXPECT_NEAR(values.at("v_rms")[0], std::sqrt(speed * speed / 2.0 + 0.0625), 1e-14);
}

TEST(FlowStatistics, VorticityIsTheAntisymmetricPartAndDivergenceTheTrace) {
  const auto constant = [](double value) { return [=](double, double) { return value; }; };
  auto context = vortices();
  context.set("velocity_gradient", {constant(0.5), constant(3.0), constant(-2.0), constant(0.25)});
  const auto values = started(context).sample(context);
  EXPECT_NEAR(values.at("vorticity_rms")[0], 5.0, 1e-14);  // |dv/dx - du/dy| = |-2 - 3|
  EXPECT_NEAR(values.at("divergence_rms")[0], 0.75, 1e-14);
}

TEST(FlowStatistics, RangesOfDensityAndVolume) {
  auto context = vortices();
  context.set("density", {[](double x, double) { return x < length / 2 ? 0.9 : 1.2; }});
  const double mean_volume = area / 1024;
  context.set("volume",
              {[=](double x, double y) { return mean_volume * (1.0 + 0.1 * (x + y < 0.1) - 0.2 * (x > 1.95)); }});
  const auto values = started(context).sample(context);
  EXPECT_DOUBLE_EQ(values.at("density_min")[0], 0.9);
  EXPECT_DOUBLE_EQ(values.at("density_max")[0], 1.2);
  EXPECT_NEAR(values.at("volume_min")[0], 0.8, 1e-14);
  EXPECT_NEAR(values.at("volume_max")[0], 1.1, 1e-14);
  EXPECT_NEAR(values.at("kinetic_energy")[0], 0.5 * 1.05 * area * speed * speed / 2.0, 1e-14);
}

TEST(FlowStatistics, MassComesFromTheConstantWhereThereIsNoDensityField) {
  auto context = vortices();
  context.remove("density");
  EXPECT_TRUE(std::isnan(started(context).number(context, "kinetic_energy")));
  EXPECT_TRUE(std::isnan(started(context).number(context, "density_min")));
  context.set_constant("density", 3.0);
  EXPECT_NEAR(started(context).number(context, "kinetic_energy"), 0.5 * 3.0 * area * speed * speed / 2.0, 1e-14);
}

TEST(FlowStatistics, WithoutAFlowItStillSaysHowParticlesFillTheBox) {
  const FakeObserverContext context(10, 12, 1.0, 1.2);
  auto observer = started(context);
  const auto values = observer.sample(context);
  for (const auto* name :
       {"v_rms", "vorticity_rms", "divergence_rms", "kinetic_energy", "compression_energy", "density_max"})
    EXPECT_TRUE(std::isnan(values.at(name)[0])) << name;
  EXPECT_TRUE(std::isnan(values.at("total_momentum")[1]));
  EXPECT_NEAR(values.at("min_spacing")[0], 1.0, 1e-12);
  EXPECT_NEAR(values.at("volume_min")[0], 1.0, 1e-12);
  const auto& plan = observer.plan(context.scene());
  EXPECT_EQ(plan.read_list(), std::vector<std::string>{"volume"});
  EXPECT_EQ(plan.optional_list(),
            (std::vector<std::string>{"velocity", "velocity_gradient", "density", "internal_energy"}));
}

TEST(FlowStatistics, SmallestSpacingIsThatOfAllPairs) {
  FakeObserverContext context(24, 20, 1.2, 1.0);
  context.jitter(0.6, 5);
  double smallest = 1e9;
  const auto x = context.position(0);
  const auto y = context.position(1);
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double dx = std::remainder(x[i] - x[j], 1.2);
      const double dy = std::remainder(y[i] - y[j], 1.0);
      smallest = std::min(smallest, std::hypot(dx, dy));
    }
  }
  EXPECT_NEAR(started(context).number(context, "min_spacing"), smallest / 0.05, 1e-12);
}

TEST(FlowStatistics, SmallestSpacingAcrossACorner) {
  FakeObserverContext context(8, 8, 0.8, 0.8);
  context.place(0, 0.001, 0.002);
  context.place(63, 0.798, 0.798);
  EXPECT_NEAR(started(context).number(context, "min_spacing"), 0.05, 1e-12);  // 3-4-5: 0.005 m of 0.1 m
}

TEST(FlowStatistics, OrderOfStorageDoesNotMatter) {
  auto context = vortices(0.1);
  context.jitter(0.3, 2);
  const auto before = started(context).sample(context);
  context.store_anew(3);
  EXPECT_EQ(started(context).sample(context), before);
}

TEST(FlowStatistics, UnitsInThePlane) {
  const auto context = vortices();
  auto observer = started(context);
  std::map<std::string, std::string> units;
  for (const auto& quantity : observer.plan(context.scene()).quantities()) {
    EXPECT_FALSE(quantity.doc_text.empty()) << quantity.name;
    units[quantity.name] = quantity.unit_text;
  }
  EXPECT_EQ(units.at("kinetic_energy"), "J/m");
  EXPECT_EQ(units.at("total_momentum"), "kg/s");
  EXPECT_EQ(units.at("min_spacing"), "1");
}

}  // namespace
}  // namespace mesogen::test
