// The plugin by itself, against exact answers: modes of the momentum equation, forces, friction, evenness of particles.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>

#include "mesogen/exec/random.hpp"
#include "mesogen/testing/plugin_harness.hpp"
#include "momentum.hpp"

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

// Neither viscosity nor sound: how fast an active flow shears at most.
TEST(Incompressible, OnlyStressLimitsTheStep) {
  EXPECT_TRUE(flow("").step_limits().empty());
  PluginHarness run = flow("", lattice(0.0,
                                       "[physics.nematic]\ntype = \"beris_edwards\"\nrotational_diffusivity = 0.4\n"
                                       "flow_alignment = 0.7\nelastic_constant = 0.02\n"
                                       "[physics.activity]\ntype = \"active_stress\"\nactivity = -0.05\n"));
  const auto limits = run.step_limits();
  EXPECT_NEAR(limits.at("shear: 0.2 mu / largest stress"), 0.2 * 0.5 / 0.05, 1e-12);
  EXPECT_EQ(limits.at("elasticity: stable diffusion by Gamma K"), std::numeric_limits<double>::infinity());
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

// Whatever drives it and however it started: k . u = 0 for every mode, to rounding.
TEST(Incompressible, ModesOfTheVelocityHaveNoDivergence) {
  using incompressible::Momentum;
  const mesh::Grid<2> grid{{16, 12}, {1.0, 1.5}};
  const mesh::ModeLoop<2> loop(grid);
  Momentum<2> momentum(grid, {.density = 2.0, .viscosity = 0.1, .friction = 0.3});
  std::array<std::vector<mesh::Complex>, 2> noise;
  const Momentum<2>::ConstModes modes = [&] {
    Momentum<2>::ConstModes all{};
    for (int d = 0; d < 2; ++d) {
      for (std::size_t n = 0; n < grid.mode_count(); ++n)
        noise[d].emplace_back(exec::random_uniform(1, static_cast<std::int64_t>(n), 2 * d) - 0.5,
                              exec::random_uniform(1, static_cast<std::int64_t>(n), 2 * d + 1) - 0.5);
      all[d] = noise[d].data();
    }
    return all;
  }();
  momentum.start(loop, 0.0, modes);
  momentum.take(loop, 0.05, modes);
  momentum.advance_to(loop, 0.1);
  double largest = 0.0;
  double divergence = 0.0;
  loop.for_each([&](std::size_t n, const auto& wave) {
    const auto u = momentum.velocity()[0][n];
    const auto v = momentum.velocity()[1][n];
#pragma omp critical
    {
      divergence = std::max(divergence, abs(wave[0] * u + wave[1] * v));
      largest = std::max(largest, abs(u) * std::hypot(wave[0], wave[1]));
    }
  });
  EXPECT_GT(largest, 1.0);
  EXPECT_LT(divergence, 1e-14 * largest);
}

// The gradient that others read against differences of the velocity itself between near particles.
TEST(Incompressible, GradientsAreThoseOfTheVelocity) {
  PluginHarness run = flow("", lattice(0.01));
  run.set("velocity", {[](double x, double y) { return std::sin(k * (x + y)); },
                       [](double x, double y) { return std::cos(k * (x - y)) - std::sin(k * (x + y)); }});
  run.set("acceleration", {none, none});
  run.start();
  const auto x = run.position(0);
  const auto y = run.position(1);
  const auto uy = run.values("velocity_gradient", 1);
  const auto vx = run.values("velocity_gradient", 2);
  for (std::size_t i = 0; i < x.size(); ++i) {
    // cos k (x - y) has a divergence: half of it stays, turned along its waves.
    const double shear = k * std::cos(k * (x[i] + y[i]));
    const double kept = -0.5 * k * std::sin(k * (x[i] - y[i]));
    ASSERT_NEAR(uy[i], shear - kept, 1e-2 * k);
    ASSERT_NEAR(vx[i], -shear + kept, 1e-2 * k);
  }
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

/// What the case is refused with.
std::string refusal(const TestScene& scene) {
  try {
    flow("", scene).start();
  } catch (const Error& error) {
    return error.code() == ExitCode::bad_case ? error.what() : "another exit code";
  }
  return "it was taken";
}

void expect_refused(const TestScene& scene, const std::string& why) {
  const std::string text = refusal(scene);
  EXPECT_NE(text.find(why), std::string::npos) << text;
}

TEST(Incompressible, WallsAreRefusedWithTheWayOut) {
  TestScene scene;
  scene.boundary = "walls";
  expect_refused(scene,
                 "an incompressible flow needs a box that is periodic along every axis: take boundary = "
                 "\"periodic_wrap\" or \"periodic_ghosts\", or between walls type = \"wcsph\"");
}

TEST(Incompressible, ANematicMustTellItsDiffusivity) {
  TestScene scene;
  scene.constants = {{"elastic_constant", 0.02}};
  expect_refused(scene,
                 "an incompressible flow slows the Laplacian of the order tensor by its diffusivity: the nematic must "
                 "publish the constant rotational_diffusivity beside elastic_constant");
}

}  // namespace
