#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "case_run.hpp"
#include "fake_pass_context.hpp"
#include "mesogen/diagnostics/error.hpp"
#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

Scene box_of(double length, double smoothing_length) {
  Scene scene;
  scene.dimension = 2;
  scene.box = {length, length, 0.0};
  scene.smoothing_length = smoothing_length;
  scene.diffusion_step = 0.125 * smoothing_length * smoothing_length;
  return scene;
}

/// c0 as the step limit by sound shows it.
double sound_speed(const Scene& scene, std::map<std::string, double> more = {}) {
  more.insert({{"density", 2.0}, {"viscosity", 0.1}});
  return 0.25 * scene.smoothing_length / PhysicsUnderTest("wcsph", more, scene).limits(scene).at("sound: 0.25 h / c0");
}

TEST(Wcsph, SoundSpeedIsTheLargestThatAnythingNeeds) {
  Scene scene = box_of(10.0, 1.0);
  // Free of cost: the acoustic limit meets the viscous one at 2 mu / (rho h).
  EXPECT_DOUBLE_EQ(sound_speed(scene), 2.0 * 0.1 / 2.0);
  scene.scales.stress = 0.08;  // sqrt(stress / (rho delta)), delta = 0.01
  EXPECT_DOUBLE_EQ(sound_speed(scene), 2.0);
  EXPECT_DOUBLE_EQ(sound_speed(scene, {{"density_variation", 0.0025}}), 4.0);
  scene.scales.passing_stress = 5.0 * 0.18;  // may compress five times as much
  EXPECT_DOUBLE_EQ(sound_speed(scene), 3.0);
  scene.scales.speed = 0.5;  // ten times as fast
  EXPECT_DOUBLE_EQ(sound_speed(scene), 5.0);
  EXPECT_DOUBLE_EQ(sound_speed(scene, {{"sound_speed", 1.5}}), 1.5);
  // mu u / (rho L delta): a very viscous flow
  EXPECT_DOUBLE_EQ(sound_speed(box_of(1.0, 1e3), {{"viscosity", 100.0}}), 0.1);
  Scene creeping = box_of(1.0, 1e4);
  creeping.scales.speed = 1.0;
  EXPECT_DOUBLE_EQ(sound_speed(creeping, {{"viscosity", 100.0}}), std::sqrt(100.0 / (2.0 * 0.01)));
}

TEST(Wcsph, ViscosityLimitsTheStep) {
  const Scene scene = box_of(10.0, 0.5);
  const PhysicsUnderTest flow("wcsph", {{"density", 2.0}, {"viscosity", 0.1}}, scene);
  EXPECT_DOUBLE_EQ(flow.limits(scene).at("viscosity: stable diffusion by mu / rho"), 0.125 * 0.25 * 2.0 / 0.1);
}

TEST(Wcsph, ContinuityFollowsTheDivergence) {
  const PhysicsUnderTest flow("wcsph", {{"density", 2.0}, {"viscosity", 0.1}}, box_of(10.0, 0.5));
  FakePassContext context(1);
  context.set_step_size(0.1);
  context.set("compression", {0.5});
  context.set("velocity_gradient", {0.3, 1e9, 1e9, -0.1});
  context.set("compression_rate", {0.0});
  context.set("compression_midpoint", {0.0});
  context.set("density", {0.0});
  flow.run("continuity", context);
  EXPECT_NEAR(context.at("compression_rate", 0), -1.5 * 0.2, 1e-15);
  EXPECT_NEAR(context.at("compression_midpoint", 0), 0.5 - 0.05 * 1.5 * 0.2, 1e-15);
  EXPECT_NEAR(context.at("density", 0), 2.0 * (1.5 - 0.05 * 1.5 * 0.2), 1e-15);
}

/// Part of a density that alternates from particle to particle which is left after 20 steps of a box at rest.
double alternating_density_left(const std::string& diffusion, const std::string& more = "") {
  CaseText text(1.0, 16);
  text.flow(0.1, "sound_speed = 3.0\ndensity_diffusion = " + diffusion + "\n" + more).read("\"compression\"");
  CaseRun run(text);
  Field& compression = run.state().fields.at("compression");
  const auto sign = [&](Index i) {
    const auto cell = [&](int axis) {
      return static_cast<int>(run.state().particles.position[axis].host()[static_cast<std::size_t>(i)] * 16.0);
    };
    return (cell(0) + cell(1)) % 2 == 0 ? 1.0 : -1.0;
  };
  std::vector<double> start;
  for (Index i = 0; i < run.state().particles.count(); ++i) compression.set(0, i, 1e-6 * sign(i));
  ++compression.version;
  const auto before = run.field("compression");
  run.run_steps(20);
  const auto after = run.field("compression");
  double left = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) left += after[i] * before[i] / (1e-12 * 256.0);
  return left;
}

// delta-SPH: dc/dt gains delta h c0 lap c. The gradient of the pressure does not see what alternates.
TEST(Wcsph, DiffusionEvensOutWhatPressureDoesNotSee) {
  EXPECT_NEAR(alternating_density_left("0.0"), 1.0, 1e-3);
  EXPECT_LT(alternating_density_left("0.1"), 0.9);
}

TEST(Wcsph, DiffusesDensityLessInCreepingFlow) {
  EXPECT_EQ(alternating_density_left("\"auto\""), alternating_density_left("0.1"));
  const std::string creeping = "inertia = false\nexpected_speed = 0.1";
  const double left = alternating_density_left("\"auto\"", creeping);
  EXPECT_EQ(left, alternating_density_left("0.02", creeping));
  EXPECT_NE(left, alternating_density_left("0.1", creeping));
}

/// Largest speed, m/s, that a uniform pressure gives to particles that lie unevenly, in one step from rest.
double speed_by_uniform_pressure(const std::string& form) {
  CaseText text(1.0, 16);
  text.flow(0.1, "sound_speed = 3.0\npressure_form = \"" + form + "\"");
  text.section("particles", "spacing = 0.0625\narrangement = \"jittered\"\njitter = 0.2\nseed = 1");
  CaseRun run(text);
  Field& compression = run.state().fields.at("compression");
  for (Index i = 0; i < run.state().particles.count(); ++i) compression.set(0, i, 0.01);
  ++compression.version;
  run.run_steps(2);  // the rates of the first were found at the start
  double fastest = 0.0;
  for (const int axis : {0, 1})
    for (const double u : run.field("velocity", axis)) fastest = std::max(fastest, std::abs(u));
  return fastest;
}

TEST(Wcsph, UniformPressureMovesNothingByItsDifferences) {
  EXPECT_LT(speed_by_uniform_pressure("difference"), 1e-13);
  EXPECT_GT(speed_by_uniform_pressure("corrected"), 1e-3);
}

// A pair that nearly coincides would be thrown apart as 1 / distance^2, out of the box.
TEST(Wcsph, ShiftMovesNoParticleByMoreThanAFifthOfASpacing) {
  CaseText text(1.0, 16);
  text.flow(0.1)
      .modes("velocity", "[[1, 0, 0.1, 0.3], [1, 2, 0.1, 1.0]]")
      .section("time", "end = 1.0\nstep = 1e-3")
      .read("\"shift_velocity\"");
  CaseRun run(text);
  const double distance[] = {1e-5, 2e-5};
  for (const int axis : {0, 1}) {
    const auto values = run.state().particles.position[axis].host(exec::Access::read_write);
    values[40] = values[41] + distance[axis] / 16.0;
  }
  run.run_steps(1);  // ends with the rates of where particles then are
  const auto x = run.field("shift_velocity", 0);
  const auto y = run.field("shift_velocity", 1);
  double largest = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) largest = std::max(largest, 1e-3 * std::hypot(x[i], y[i]));
  EXPECT_NEAR(largest, 0.2 / 16.0, 1e-9);
}

// p = rho0 c0^2 / 7 ((1 + c)^7 - 1), to the last digit even where (1 + c)^7 - 1 cancels
TEST(Wcsph, PressureIsTaitsAndLosesNoDigits) {
  const PhysicsUnderTest flow("wcsph", {{"density", 2.0}, {"viscosity", 0.1}, {"sound_speed", 3.0}});
  for (const double c : {-0.02, 1e-12, 1e-3, 0.3}) {
    FakePassContext context(1);
    context.set("compression_midpoint", {c});
    context.set("pressure", {0.0});
    context.set("pressure_term", {0.0});
    flow.run("equation of state", context);
    const double exact = 2.0 * 9.0 / 7.0 * std::expm1(7.0 * std::log1p(c));
    EXPECT_NEAR(context.at("pressure", 0) / exact, 1.0, 1e-14);
    const double density = 2.0 * (1.0 + c);
    EXPECT_NEAR(context.at("pressure_term", 0) / (exact / (density * density)), 1.0, 1e-14);
  }
}

// rho0 e(c) against the integral of p / rho^2 over rho (Simpson), p as the equation of state gives it
TEST(Wcsph, InternalEnergyIsTheWorkOfThePressure) {
  const PhysicsUnderTest flow("wcsph", {{"density", 2.0}, {"viscosity", 0.1}, {"sound_speed", 3.0}});
  const auto work = [&](double c) {  // d(rho0 e) / dc
    FakePassContext context(1);
    context.set("compression_midpoint", {c});
    context.set("pressure", {0.0});
    context.set("pressure_term", {0.0});
    flow.run("equation of state", context);
    return 2.0 * 2.0 * context.at("pressure_term", 0);
  };
  for (const double c : {-0.3, -0.02, 1e-3, 0.1, 0.3}) {
    FakePassContext context(1);
    context.set("compression", {c});
    context.set("internal_energy", {0.0});
    flow.run("internal energy, for readers", context);
    constexpr int parts = 200;
    double sum = 0.0;
    for (int n = 0; n < parts; ++n) {
      const double step = c / parts;
      sum += step / 6.0 * (work(n * step) + 4.0 * work((n + 0.5) * step) + work((n + 1) * step));
    }
    EXPECT_NEAR(context.at("internal_energy", 0) / sum, 1.0, 1e-9) << c;
    const double closed = 2.0 * 9.0 / 7.0 * ((std::pow(1.0 + c, 6) - 1.0) / 6.0 + 1.0 / (1.0 + c) - 1.0);
    EXPECT_NEAR(context.at("internal_energy", 0), closed, 1e-15);
  }
  FakePassContext context(1);
  context.set("compression", {1e-12});
  context.set("internal_energy", {0.0});
  flow.run("internal energy, for readers", context);
  EXPECT_NEAR(context.at("internal_energy", 0) / (2.0 * 9.0 * 0.5e-24), 1.0, 1e-11);  // to the last digits
}

TEST(Wcsph, PublishesWhatItIs) {
  const PhysicsUnderTest flow("wcsph", {{"density", 2.0}, {"viscosity", 0.1}, {"expected_speed", 0.7}});
  EXPECT_EQ(flow.scene().constant("density"), 2.0);
  EXPECT_EQ(flow.scene().constant("viscosity"), 0.1);
  EXPECT_EQ(flow.scene().scales.speed, 0.7);
}

/// A channel of nematic, 2 m between walls.
Scene active_channel() {
  Scene scene = box_of(4.0, 0.1);
  scene.box[1] = 2.0;
  scene.periodic[1] = false;
  scene.constants = {{"activity", -0.3},      {"elastic_constant", 0.01}, {"rotational_diffusivity", 0.5},
                     {"flow_alignment", 0.4}, {"bulk_A", -1.0},           {"bulk_C", 0.5}};
  return scene;
}

double density(const Scene& scene, std::map<std::string, double> more = {}) {
  more.insert({{"density", 2.0}, {"viscosity", 0.1}, {"inertia", 0.0}});
  const PhysicsUnderTest flow("wcsph", more, scene);
  EXPECT_EQ(flow.scene().constant("physical_density"), 2.0);
  return flow.scene().constant("density");
}

// The slowest momentum, mu k^2 / rho with half a wave between the walls, against each rate of the nematic.
TEST(Wcsph, CreepingDensityLetsMomentumRelaxFasterThanTheNematicChanges) {
  const double k2 = std::pow(std::numbers::pi / 2.0, 2);
  Scene scene = active_channel();
  const double by_activity = 0.1 * k2 / (0.3 * (2.0 + 0.4) / (2.0 * 0.1));
  EXPECT_NEAR(density(scene), by_activity / 20.0, 1e-12);
  EXPECT_NEAR(density(scene, {{"relaxation_ratio", 50.0}}), by_activity / 50.0, 1e-12);
  scene.scales.speed = 10.0;  // over 2 m
  EXPECT_NEAR(density(scene), 0.1 * k2 / 5.0 / 20.0, 1e-12);
  scene.scales.speed = 0.0;
  scene.constants["activity"] = 0.0;
  EXPECT_NEAR(density(scene), 0.1 / (0.01 * 0.5) / 20.0, 1e-12);
  scene.constants["elastic_stress"] = 1.0;
  EXPECT_NEAR(density(scene), 0.1 / (0.01 * (0.5 + 2.4 * 2.4 / 0.2)) / 20.0, 1e-12);
  // Periodic: a whole wave in the longest edge. Friction holds back the flow, and takes part in its relaxation.
  scene = active_channel();
  scene.periodic[1] = true;
  const double whole = std::pow(2.0 * std::numbers::pi / 4.0, 2);
  EXPECT_NEAR(density(scene), 0.1 * whole / (0.3 * 2.4 / 0.2) / 20.0, 1e-12);
  scene.constants["friction"] = 0.2;
  EXPECT_NEAR(density(scene), std::pow(0.1 * whole + 0.2, 2) / (0.3 * 1.2 * whole) / 20.0, 1e-12);
}

TEST(Wcsph, CreepingFlowTakesItsStepsFromTheArtificialDensity) {
  const Scene scene = active_channel();
  const double rho = density(scene);
  const PhysicsUnderTest flow("wcsph", {{"density", 2.0}, {"viscosity", 0.1}, {"inertia", 0.0}}, scene);
  EXPECT_DOUBLE_EQ(flow.limits(scene).at("viscosity: stable diffusion by mu / rho"), scene.diffusion_step * rho / 0.1);
}

TEST(Wcsph, RefusesCreepingFlowWithoutAnythingThatChanges) {
  const auto refusal = [](const std::map<std::string, double>& numbers, const Scene& scene) {
    try {
      PhysicsUnderTest("wcsph", numbers, scene);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal({{"density", 2.0}, {"viscosity", 0.1}, {"inertia", 0.0}}, box_of(1.0, 0.1)),
            "a creeping flow needs to know how fast the scene changes, and nothing in it tells: there is no nematic, "
            "moving wall or initial velocity. Give expected_speed, the largest speed of the flow, or leave inertia "
            "out");
}

TEST(Wcsph, HasARelaxationRatioOnlyInCreepingFlow) {
  try {
    (void)mesogen::testing::PluginHarness(PluginKind::physics, "wcsph",
                                          "density = 2.0\nviscosity = 0.1\nrelaxation_ratio = 50.0")
        .scene();
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("relaxation_ratio: has a meaning only with inertia = false"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
