// The plugin by itself, against exact answers: modes of the momentum equation, forces, friction, evenness of particles.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

constexpr double k = 2.0 * std::numbers::pi;  // box of 1 m

PluginHarness flow(const std::string& keys, const TestScene& scene = {}) {
  return {PluginKind::physics, "incompressible", "density = 2.0\nviscosity = 0.5\n" + keys, scene};
}

TestScene lattice(double step = 0.0, const std::string& more = "") {
  TestScene scene;
  scene.arrangement = "lattice";
  scene.across = 24;
  scene.step = step;
  scene.more = more;
  return scene;
}

/// Amplitude of sin(k x) in a component of a field.
double sine_of(PluginHarness& run, const std::string& field, int component) {
  const auto x = run.position(0);
  const auto values = run.values(field, component);
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += values[i] * std::sin(k * x[i]);
  return 2.0 * sum / static_cast<double>(x.size());
}

const PluginHarness::Function none = [](double, double) { return 0.0; };

// u_y = U sin(k x) decays as exp(-nu k^2 t), here by 0.37 in one step.
TEST(Incompressible, AShearWaveDecaysExactlyInStepsOfAnyLength) {
  const double nu = 0.5 / 2.0;
  PluginHarness run = flow("", lattice(0.1));
  run.set("velocity", {none, [](double x, double) { return 1e-3 * std::sin(k * x); }});
  run.set("acceleration", {none, none});
  run.step(3);
  EXPECT_NEAR(run.time(), 0.3, 1e-12);
  EXPECT_NEAR(sine_of(run, "velocity", 1) / (1e-3 * std::exp(-nu * k * k * 0.3)), 1.0, 1e-4);
  EXPECT_NEAR(sine_of(run, "velocity", 0), 0.0, 1e-9);
}

// A steady force f sin(k x) / rho along y: u = f / (mu k^2) at once without inertia, approached with it.
TEST(Incompressible, CreepingFlowBalancesTheForceAtOnce) {
  const double acceleration = 1e-3;
  const double balance = acceleration * 2.0 / (0.5 * k * k);
  const auto force = [=](double x, double) { return acceleration * std::sin(k * x); };
  for (const bool inertia : {false, true}) {
    PluginHarness run = flow(inertia ? "" : "inertia = false", lattice(0.05));
    run.set("velocity", {none, none}).set("acceleration", {none, force});
    run.start();
    EXPECT_NEAR(sine_of(run, "velocity", 1), inertia ? 0.0 : balance, 1e-4 * balance);
    run.step(2);
    const double reached = inertia ? 1.0 - std::exp(-0.25 * k * k * 0.1) : 1.0;
    EXPECT_NEAR(sine_of(run, "velocity", 1), reached * balance, 2e-4 * balance) << inertia;
  }
}

// A force that is a gradient moves nothing: the pressure p = f / k (1 - cos) takes it.
TEST(Incompressible, PressureTakesWhatHasDivergence) {
  PluginHarness run = flow("", lattice(0.05));
  run.set("velocity", {none, none}).set("acceleration", {[](double x, double) { return 0.3 * std::sin(k * x); }, none});
  run.start();
  EXPECT_NEAR(sine_of(run, "velocity", 0), 0.0, 1e-12);
  const auto x = run.position(0);
  const auto pressure = run.values("pressure");
  for (std::size_t i = 0; i < x.size(); ++i)
    ASSERT_NEAR(pressure[i], -2.0 * 0.3 / k * std::cos(k * x[i]), 1e-4 * 0.6 / k);
  run.step(3);
  EXPECT_NEAR(sine_of(run, "velocity", 0), 0.0, 1e-12);
}

TEST(Incompressible, VelocityHasNoDivergence) {
  PluginHarness run = flow("", lattice(0.01));
  run.set("velocity", {[](double x, double y) { return std::sin(k * (x + y)); },
                       [](double x, double y) { return std::cos(k * (x - y)); }});
  run.set("acceleration", {none, none});
  run.step(2);
  const auto ux = run.values("velocity_gradient", 0);
  const auto vy = run.values("velocity_gradient", 3);
  for (std::size_t i = 0; i < ux.size(); ++i) ASSERT_EQ(ux[i] + vy[i], 0.0);
}

// An even force drives the whole box against friction; 0.2 s are ten times as long as an explicit step may be.
TEST(Incompressible, FrictionOfAnyStrengthIsStable) {
  const std::string substrate = "[physics.substrate]\ntype = \"friction\"\ncoefficient = 200.0\n";
  const auto push = "[physics.push]\ntype = \"body_force\"\nforce = [3.0, 0.0]\n";
  for (const char* const inertia : {"true", "false"}) {
    PluginHarness run = flow(std::string("inertia = ") + inertia, lattice(0.2, substrate + push));
    run.step(20);
    EXPECT_NEAR(run.value("velocity", 0), 3.0 / 200.0, 2e-4) << inertia;
    EXPECT_NEAR(run.value("velocity", 1), 0.0, 1e-12);
  }
}

// Taylor-Green vortices are a solution with inertia: advection is balanced by pressure. Particles are carried around.
TEST(Incompressible, VorticesDecayAndKeepTheirShape) {
  TestScene scene = lattice();
  scene.across = 32;
  PluginHarness run(PluginKind::physics, "incompressible", "density = 1.0\nviscosity = 0.01\n", scene);
  run.set("velocity", {[](double x, double y) { return -std::cos(k * x) * std::sin(k * y); },
                       [](double x, double y) { return std::sin(k * x) * std::cos(k * y); }});
  run.set("acceleration", {none, none});
  run.run_until(0.5);
  const double left = std::exp(-2.0 * 0.01 * k * k * 0.5);
  const auto x = run.position(0);
  const auto y = run.position(1);
  const auto u = run.values("velocity", 0);
  double error = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i)
    error = std::max(error, std::abs(u[i] + left * std::cos(k * x[i]) * std::sin(k * y[i])));
  EXPECT_LT(error, 2e-3 * left);
}

TEST(Incompressible, ShiftEvensOutWhatTheMeshSees) {
  const auto unevenness = [](const std::string& keys) {
    PluginHarness run(PluginKind::physics, "incompressible", "density = 1.0\nviscosity = 1e-3\n" + keys, lattice(0.02));
    run.set("velocity", {[](double, double y) { return 0.2 * std::sin(k * y); }, none});
    run.set("acceleration", {none, none});
    // Denser on one side: displaced by a wave.
    run.move([](double x, double) { return 0.02 * std::sin(k * x); }, none);
    run.step(40);
    const auto x = run.position(0);
    double sum = 0.0;
    for (const double at : x) sum += std::cos(k * at);
    return std::abs(sum) / static_cast<double>(x.size());
  };
  const double before = unevenness("shift = 0.0");
  // The shear has tilted what was 0.063.
  EXPECT_GT(before, 0.04);
  EXPECT_LT(unevenness("shift = 5.0"), 0.1 * before);
}

TEST(Incompressible, WallsAreRefusedWithTheWayOut) {
  TestScene scene;
  scene.boundary = "walls";
  try {
    PluginHarness run = flow("", scene);
    run.start();
    FAIL() << "it was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_case);
    EXPECT_NE(std::string(error.what())
                  .find("an incompressible flow needs a box that is periodic along every axis: take boundary = "
                        "\"periodic_wrap\" or \"periodic_ghosts\", or between walls type = \"wcsph\""),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
