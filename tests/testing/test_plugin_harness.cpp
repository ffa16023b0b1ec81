#include "mesogen/testing/plugin_harness.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesogen/diagnostics/error.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

template <class Action>
std::string error_of(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

PluginHarness friction(const TestScene& scene = {}) {
  return {PluginKind::physics, "friction", "coefficient = 0.6", scene};
}

constexpr const char* flow = R"([physics.flow]
type = "wcsph"
density = 2.0
viscosity = 0.1)";

TEST(PluginHarness, FieldsThatNobodyMakesAreGiven) {
  auto harness = friction();
  harness.run(Phase::rates);
  const auto velocity = harness.values("velocity", 1);
  const auto density = harness.values("density");
  EXPECT_EQ(velocity.size(), 400U);
  const auto [low, high] = std::ranges::minmax(density);
  EXPECT_GT(low, 0.5);
  EXPECT_LT(low, 0.6);
  EXPECT_GT(high, 1.4);
  EXPECT_LT(high, 1.5);
  const auto acceleration = harness.values("acceleration", 1);
  for (std::size_t i = 0; i < velocity.size(); ++i) ASSERT_DOUBLE_EQ(acceleration[i], -0.6 / density[i] * velocity[i]);
}

TEST(PluginHarness, TheSeedGivesTheNumbers) {
  const auto velocity = [](std::int64_t seed) {
    auto harness = friction();
    harness.seed(seed);
    return harness.values("velocity");
  };
  EXPECT_EQ(velocity(5), velocity(5));
  EXPECT_NE(velocity(5), velocity(6));
}

TEST(PluginHarness, WhatIsSetStaysUnderAnotherSeed) {
  auto harness = friction();
  harness.set("density", {[](double x, double y) { return x + 2.0 * y; }}).seed(9);
  const auto density = harness.values("density");
  const auto x = harness.position(0);
  const auto y = harness.position(1);
  for (std::size_t i = 0; i < density.size(); ++i) ASSERT_DOUBLE_EQ(density[i], x[i] + 2.0 * y[i]);
}

TEST(PluginHarness, ComponentsCanBeSetByParticle) {
  auto harness = friction();
  std::vector<double> by_particle(400);
  for (std::size_t i = 0; i < by_particle.size(); ++i) by_particle[i] = static_cast<double>(i);
  harness.set_values("velocity", 0, by_particle).set_values("velocity", 1, std::vector<double>(400, -1.0));
  EXPECT_EQ(harness.values("velocity", 0), by_particle);
  EXPECT_EQ(harness.value("velocity", 1, 7), -1.0);
}

TEST(PluginHarness, ADerivedFieldCanBeGivenOrMade) {
  PluginHarness harness(PluginKind::physics, "active_stress", "activity = 0.5");
  harness.set("order_tensor", {[](double x, double) { return x * (1.0 - x); }, [](double, double) { return 0.0; }});
  harness.set("density", {1.0});
  harness.start();
  const auto x = harness.position(0);
  const auto acceleration = harness.values("acceleration");
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double expected = -0.5 * (1.0 - 2.0 * x[i]);
    if (x[i] > 0.25 && x[i] < 0.75) {
      ASSERT_NEAR(acceleration[i], expected, 0.02);
    }
  }
  EXPECT_EQ(error_of([&] {
              harness.set("order_tensor_gradient", {1.0, 0.0, 0.0, 0.0});
            }),
            "the scene has no field 'order_tensor_gradient' of its own: set it before anything runs");
  PluginHarness given(PluginKind::physics, "active_stress", "activity = 0.5");
  EXPECT_EQ(given.particles(), 400);  // the scene is there already
  given.set("order_tensor_gradient", {1.0, 0.0, 0.0, 0.0}).set("density", {1.0});
  given.start();
  EXPECT_DOUBLE_EQ(given.value("acceleration", 0, 33), -0.5);
}

TEST(PluginHarness, RunsWithOtherPlugins) {
  TestScene scene;
  scene.arrangement = "lattice";
  scene.more = flow;
  auto harness = friction(scene);
  harness.set("velocity", {0.25, 0.0}).set("compression", {0.0});
  harness.run_until(0.2);
  EXPECT_EQ(harness.time(), 0.2);
  EXPECT_NEAR(harness.value("velocity", 0), 0.25 * std::exp(-0.6 / 2.0 * 0.2), 1e-4);
  EXPECT_NEAR(harness.path(0)[0] - 0.025, 0.25 / 0.3 * (1.0 - std::exp(-0.06)), 1e-4);
}

TEST(PluginHarness, TakesACompleteCase) {
  PluginHarness harness(R"([domain]
size = [2.0, 1.0]
boundary = "periodic_ghosts"
[particles]
spacing = 0.1
[kernel]
type = "wendland_c2"
[velocity]
type = "uniform"
value = [0.5, 0.0]
[physics.drag]
type = "friction"
coefficient = 0.25
[time]
end = 1.0)");
  harness.set("density", {0.5});
  harness.run("physics.drag: damping of velocity");
  EXPECT_EQ(harness.particles(), 200);
  EXPECT_DOUBLE_EQ(harness.value("acceleration", 0), -0.25);
}

TEST(PluginHarness, ASinglePassAddsToWhatWasSet) {
  auto harness = friction();
  harness.set("velocity", {1.0, 0.0}).set("density", {0.6}).set("acceleration", {10.0, 0.0});
  harness.run("damping of velocity");
  EXPECT_DOUBLE_EQ(harness.value("acceleration", 0), 9.0);
  harness.run(Phase::rates);
  EXPECT_DOUBLE_EQ(harness.value("acceleration", 0), -1.0) << "a step starts from zero";
}

TEST(PluginHarness, ShufflingChangesTheStorageAlone) {
  PluginHarness harness(PluginKind::observer, "pathlines", "count = 4");
  harness.start();
  const auto before = harness.sample();
  harness.shuffle(3);
  EXPECT_EQ(harness.sample(), before);
  EXPECT_EQ(harness.path(0), harness.position(0));
}

TEST(PluginHarness, SaysWhatIsWrong) {
  EXPECT_NE(error_of([] {
              PluginHarness(PluginKind::physics, "frction").start();
            }).find("no physics plugin is called \"frction\""),
            std::string::npos);
  EXPECT_EQ(error_of([] { PluginHarness(PluginKind::physics, "friction", "coefficient = -1.0").start(); }),
            "the test's case:16:15: physics.tested.coefficient: must be >= 0 kg/(m3 s), but is -1.0");
  EXPECT_EQ(error_of([] { friction().run("drag"); }),
            "there is no pass 'drag' in this scene (there are: damping of velocity)");
  EXPECT_EQ(error_of([] { (void)friction().values("speed"); }),
            "this scene has no field 'speed' (it has: acceleration, correction, density, density_gradient, "
            "density_laplacian, velocity, velocity_gradient, velocity_laplacian, volume)");
  EXPECT_EQ(error_of([] { (void)friction().values("velocity", 2); }),
            "the field 'velocity' has the components 0 to 1, not 2");
  EXPECT_EQ(error_of([] { friction().step(); }), "nothing limits the step in this scene: give TestScene::step");
  EXPECT_EQ(error_of([] { (void)friction().observer(); }), "this harness tests no observer plugin");
  EXPECT_EQ(error_of([] { friction().sample(); }), "there is no observer in this scene to sample");
  EXPECT_EQ(error_of([] {
              friction().set("velocity", {1.0, 0.0, 0.0}).start();
            }),
            "the test's case: no field has 3 components: 1, 2 or 4");
  EXPECT_EQ(error_of([] { friction().set("volume", {1.0}).start(); }),
            "the test's case: the field 'volume' follows from the positions of the particles: it cannot be given");
  auto started = friction();
  started.start();
  EXPECT_EQ(error_of([&] { started.set("temperature", {1.0}); }),
            "the scene has no field 'temperature' of its own: set it before anything runs");
  EXPECT_EQ(error_of([&] { started.set("velocity", {1.0}); }),
            "the field 'velocity' has 2 components here, but 1 are given");
}

}  // namespace
