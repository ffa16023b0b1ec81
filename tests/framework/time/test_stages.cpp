// Linear terms in stages, against exact solutions: accurate, stable and balanced however stiff they are.

#include "time/stages.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "case_run.hpp"
#include "forecast/steps.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

constexpr double pi = std::numbers::pi;

TEST(Stages, AreOddAndAsManyAsTheStepNeeds) {
  EXPECT_EQ(stages_needed(1.0, 1e-3), 2);
  EXPECT_EQ(stages_needed(2.0, 1.0), 2);
  for (const double stiffness : {2.1, 5.1, 30.0, 1e3, 1e6}) {
    const int stages = stages_needed(stiffness, 1.0);
    const auto reach = [](double s) { return (s * s + s - 2.0) / 2.0; };
    EXPECT_EQ(stages % 2, 1);
    EXPECT_GE(reach(stages), stiffness);
    EXPECT_TRUE(stages == 3 || reach(stages - 2) < stiffness) << stages;
  }
}

TEST(Stages, TheFastestRateGoesWithTheDivisor) {
  LinearTerms terms;
  terms.diffusion.number = 0.5;
  terms.damping.number = 3.0;
  terms.usual_divisor = 2.0;
  EXPECT_DOUBLE_EQ(largest_rate(terms, 10.0), 1.2 * (0.5 * 10.0 + 3.0) / 2.0);
}

/// A wave of velocity across the box that viscosity takes down, over the exact one, after some of its decay times.
double shear_wave(double step, const std::string& boundary, double decay_times) {
  constexpr double viscosity = 0.1;
  constexpr double wave = 2.0 * pi;
  CaseText text(1.0, 32);
  text.boundary(boundary)
      .section("time", fmt::format("end = 1e6\nstepping = \"stabilised\"\nstep = {:.17g}", step))
      .modes("velocity", "[[1, 0, 1e-4, 0.0]]")
      .flow(viscosity);
  CaseRun run(text);
  const auto amplitude_now = [&] { return wave_of(run, run.field("velocity", 1), 1, 0).sine; };
  const double amplitude = amplitude_now();
  const double time = decay_times / (viscosity * wave * wave);
  run.run_to(time);
  return amplitude_now() / amplitude / std::exp(-decay_times);
}

// Explicit steps end at 7e-4 s: these are up to 36 times as long. What is left is the error of the Laplacian.
TEST(Stages, TakeLongStepsAsAccuratelyAsShortOnes) {
  const double converged = shear_wave(0.0253303 / 80.0, "periodic_ghosts", 1.0);
  EXPECT_NEAR(converged, 1.0, 0.015);
  const auto error = [&](double steps) {
    return std::abs(shear_wave(0.2533030 / steps, "periodic_ghosts", 1.0) - converged);
  };
  const double long_steps = error(10.0);
  EXPECT_LT(long_steps, 2e-3);
  EXPECT_NEAR(std::log2(long_steps / error(20.0)), 2.0, 0.4);
  EXPECT_NEAR(shear_wave(0.0253303, "periodic_wrap", 1.0), shear_wave(0.0253303, "periodic_ghosts", 1.0), 1e-6);
}

// The balance of a force with friction and viscosity between walls: kept to rounding in steps of a thousand times the
// relaxation time, and reached by halving the distance to it, at least, in each.
TEST(Stages, KeepABalanceHoweverStiffItIs) {
  const auto distance = [](int steps) {
    CaseText text(1.0, 20);
    text.section("domain", "size = [1.0, 1.0]\nboundary = { type = \"walls\", axes = [\"y\"] }")
        .section("time", "end = 1e6\nstepping = \"stabilised\"\nstep = 0.5")
        .flow(0.1, "shift = 0.0\nsound_speed = 0.5\nmotion = \"eulerian\"")
        .section("physics.substrate", "type = \"friction\"\ncoefficient = 2000.0")
        .section("physics.drive", "type = \"body_force\"\nforce = [0.2, 0.0]");
    CaseRun run(text);
    run.run_steps(steps);
    const auto y = run.path(1);
    const auto speed = run.field("velocity", 0);
    double most = 0.0;
    for (std::size_t i = 0; i < y.size(); ++i)  // away from the layer at the walls, 7 mm thick
      if (std::abs(y[i] - 0.5) < 0.15) most = std::max(most, std::abs(speed[i] / 1e-4 - 1.0));
    return most;
  };
  EXPECT_LT(distance(4), 0.2);
  EXPECT_LT(distance(30), 1e-6);
}

// What a field with curvature at a wall has beyond it is no symmetric function of what it has before it. Stages of that
// alone make some waves at a wall grow tenfold in each of these steps.
TEST(Stages, TakeWavesDownAtWallsHoweverManyTheyAre) {
  CaseText text(1.0, 40);
  text.section("domain", "size = [0.25, 1.0]\nboundary = { type = \"walls\", axes = [\"y\"] }")
      .section("time", "end = 1e6\nstepping = \"stabilised\"\nstep = 1.2")
      .precision("single")
      .modes("velocity", "[[0, 1, 1e-6, 0.4], [1, 3, 1e-6, 0.0]]")
      .flow(1.0, "shift = 0.0\nsound_speed = 0.5");
  CaseRun run(text);
  EXPECT_GT(forecast_steps(run.setup()).stages.at("velocity"), 70);
  const double fastest = run.stepper().motion().fastest;
  run.run_steps(60);
  EXPECT_LT(run.stepper().motion().fastest, 1e-4 * fastest);
}

}  // namespace
