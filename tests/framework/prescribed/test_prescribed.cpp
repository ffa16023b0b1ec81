// Numbers that vary in space and time, in whole cases: what they do.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "error_of.hpp"
#include "lit_scene.hpp"
#include "png_file.hpp"

namespace mesogen {
namespace {

using namespace test;

/// All that a run ends with.
std::vector<double> end_of(const CaseText& text, const Settings& settings, int steps = 10) {
  CaseRun run(text, settings);
  run.run_steps(steps);
  std::vector<double> all;
  for (const char* const field : {"velocity", "order_tensor"})
    for (int c = 0; c < 2; ++c) {
      const auto values = run.field(field, c);
      all.insert(all.end(), values.begin(), values.end());
    }
  for (int d = 0; d < 2; ++d) {
    const auto values = run.path(d);
    all.insert(all.end(), values.begin(), values.end());
  }
  return all;
}

// Of each number that may vary, in explicit and stabilised steps, in both precisions.
TEST(Prescribed, WhatIsTheSameEverywhereGivesTheBitsOfTheNumber) {
  const Settings expressions = {
      "physics.activity.activity='0.3 + 0 * x'", "physics.substrate.coefficient='0.5 + 0 * t'",
      "physics.nematic.elastic_constant='0.1 + 0 * x * y'", "physics.push.force=['0.1 + 0 * y', -0.2]"};
  for (const char* const stepping : {"explicit", "stabilised"})
    for (const char* const precision : {"single", "double"}) {
      const Settings both = {"time.stepping=" + std::string(stepping), "run.precision=" + std::string(precision)};
      const auto plain = end_of(active("0.3"), both);
      for (const std::string& one : expressions) {
        Settings with = both;
        with.push_back(one);
        EXPECT_EQ(end_of(active("0.3"), with), plain) << stepping << ", " << precision << ", " << one;
      }
    }
}

// Far from the line each half is as in a box of its activity alone, to the last bit: a step reaches a few supports
// far.
TEST(Prescribed, HalvesAreAsInScenesOfTheirOwn) {
  const auto scene = [](const std::string& activity, const std::string& form, const std::string& sound_speed) {
    CaseText text = active(activity, "sound_speed = " + sound_speed);
    text.section("particles", "spacing = 0.125\narrangement = \"jittered\"\njitter = 0.05\nseed = 3");
    CaseRun run(text, {"time.step=0.001", "physics.activity.form=" + form});
    run.run_steps(1);
    return run;
  };
  for (const char* const form : {"corrected", "conservative"}) {
    CaseRun halves = scene("'0.3 * (x < 5)'", form, "4.0");
    CaseRun lit = scene("0.3", form, "4.0");
    CaseRun dark = scene("0.0", form, "4.0");
    const auto x = halves.path(0);
    const auto found = halves.field("acceleration", 0);
    const auto of_lit = lit.field("acceleration", 0);
    const auto of_dark = dark.field("acceleration", 0);
    int far_away = 0;
    for (std::size_t n = 0; n < x.size(); ++n) {
      const double in_half = std::fmod(x[n] + length, length / 2.0);
      if (std::min(in_half, length / 2.0 - in_half) < 2.0) continue;
      ++far_away;
      EXPECT_EQ(found[n], x[n] < 5.0 ? of_lit[n] : of_dark[n]) << x[n];
    }
    EXPECT_GT(far_away, 500);
  }
}

// The force is the divergence of zeta Q: over a periodic box it adds up to nothing, though zeta jumps. (zeta div Q
// alone would push the fluid by the jump of zeta Q at each line.)
TEST(Prescribed, ActivityThatJumpsDrivesNoNetFlow) {
  CaseText text = active("'0.3 * (x < 5)'");
  text.section("director", "type = \"uniform\"\nangle = 0.0")
      .section("particles", "spacing = 0.25\narrangement = \"lattice\"");
  CaseRun run(text, {"physics.push.force=[0.0, 0.0]"});
  const auto force = run.field("acceleration", 0);
  const auto x = run.path(0);
  double at_line = 0.0;
  double all = 0.0;
  for (std::size_t n = 0; n < force.size(); ++n) {
    all += force[n] * 0.0625;
    if (std::abs(x[n] - 5.0) < 1.0) at_line += force[n] * 0.0625;
  }
  // -zeta Q11 falls from -0.3 to 0 towards x > 5: a force of 0.3 on each metre of the line.
  EXPECT_NEAR(at_line, 0.3 * length, 1e-9);
  EXPECT_NEAR(all, 0.0, 1e-9);
}

TEST(Prescribed, SmoothActivityGivesTheExactForce) {
  CaseText text = active("'0.3 + 0.1 * sin(2 * pi * x / Lx)'");
  text.section("director", "type = \"uniform\"\nangle = 30.0")
      .section("particles", "spacing = 0.25\narrangement = \"lattice\"");
  CaseRun run(text, {"physics.push.force=[0.0, 0.0]"});
  const double k = 2.0 * std::numbers::pi / length;
  const auto x = run.path(0);
  // f = -Q grad zeta, Q = (cos 60, sin 60)
  const auto fx = run.field("acceleration", 0);
  const auto fy = run.field("acceleration", 1);
  for (std::size_t n = 0; n < x.size(); ++n) {
    const double slope = 0.1 * k * std::cos(k * x[n]);
    EXPECT_NEAR(fx[n], -0.5 * slope, 0.01 * 0.1 * k);
    EXPECT_NEAR(fy[n], -std::sqrt(0.75) * slope, 0.01 * 0.1 * k);
  }
}

TEST(Prescribed, IsAFieldThatCanBeStored) {
  CaseText text = active("'0.1 * x + t'");
  text.read("\"activity\", \"activity_gradient\"");
  CaseRun run(text);
  run.run_steps(3);
  const auto value = run.field("activity");
  const auto slope = run.field("activity_gradient", 0);
  const auto x = run.path(0);
  for (std::size_t n = 0; n < x.size(); ++n) {
    const double inside = x[n] - std::floor(x[n] / length) * length;
    EXPECT_NEAR(value[n], 0.1 * inside + run.time(), 1e-12);
    if (inside < 0.26 || inside > length - 0.26) continue;
    EXPECT_NEAR(slope[n], 0.1, 1e-12);
  }
}

// So runs with and without a pattern can be compared.
TEST(Prescribed, ANumberCanBeStoredByTheSameName) {
  CaseText stored = active("0.3");
  stored.read("\"activity\", \"body_force\"");
  CaseRun run(stored);
  EXPECT_FALSE(run.setup().scene.varying.contains("activity"));
  run.run_steps(3);
  for (const double value : run.field("activity")) EXPECT_EQ(value, 0.3);
  for (const double value : run.field("body_force", 1)) EXPECT_EQ(value, -0.2);
  CaseRun plain(active("0.3"));
  plain.run_steps(3);
  EXPECT_EQ(run.field("velocity"), plain.field("velocity"));
}

TEST(Prescribed, AnImageLiesOverTheBoxWithItsTopAtTheTop) {
  const std::string top = test::write_png("top.png", 1, 2, {255, 0});
  const std::string bottom = test::write_png("bottom.png", 1, 2, {0, 255});
  CaseText text = active("{ image = ['" + top + "', '" + bottom + "'], times = [0.0, 1.0], low = 0.1, high = 0.3 }");
  text.read("\"activity\"").section("time", "end = 1.0\nstep = 0.005");
  CaseRun run(text);
  const auto check = [&](double share) {
    const auto value = run.field("activity");
    const auto y = run.path(1);
    for (std::size_t n = 0; n < value.size(); ++n) {
      // Brightness between the middles of the pixels, at 2.5 and 7.5 m; it goes on across the periodic face.
      const double bright = y[n] > 2.5 && y[n] < 7.5 ? (y[n] - 2.5) / 5.0
                            : y[n] <= 2.5            ? (2.5 - y[n]) / 5.0
                                                     : (12.5 - y[n]) / 5.0;
      EXPECT_NEAR(value[n], 0.1 + 0.2 * ((1.0 - share) * bright + share * (1.0 - bright)), 1e-12);
    }
  };
  check(0.0);
  // Times count, though nothing may have moved.
  run.state().time = 0.25;
  check(0.25);
}

// At rest the torque K theta' is the same everywhere: theta = 60 degrees ln(1 + y) / ln 2 for K ~ 1 + y between walls
// that hold the director at 0 and 60 degrees.
TEST(Prescribed, AnElasticConstantThatVariesHoldsAUniformTorque) {
  CaseText text(1.0, 20);
  text.section("domain",
               "size = [1.0, 1.0]\nboundary = { type = \"walls\", axes = [\"y\"], anchoring = \"angle\", angle_high = "
               "60.0 }")
      .section("director", "type = \"uniform\"\nangle = 30.0")
      .section("physics.nematic",
               "type = \"beris_edwards\"\nrotational_diffusivity = 1.0\nflow_alignment = 0.0\n"
               "elastic_constant = '0.5 * (1 + y)'\nbulk = { A = -400.0, C = 200.0 }")
      .read("\"order_tensor\"");
  CaseRun run(text);
  run.run_to(1.0);
  const auto q11 = run.field("order_tensor", 0);
  const auto q12 = run.field("order_tensor", 1);
  const auto y = run.path(1);
  for (std::size_t n = 0; n < y.size(); ++n) {
    const double angle = 0.5 * std::atan2(q12[n], q11[n]) * 180.0 / std::numbers::pi;
    EXPECT_NEAR(angle, 60.0 * std::log2(1.0 + y[n]), 0.3) << y[n];
  }
}

// Where K varies, the energy's density pushes too: all of the force is the divergence of one stress.
TEST(Prescribed, ElasticForcesAreTheDivergenceOfTheirStress) {
  CaseText text(length, 60);
  text.modes("director", "[[1, 0, 0.3, 0.4], [1, 2, 0.2, 1.1]]")
      .flow(1.0)
      .nematic(0.4, 0.7, 0.1)
      .section("physics.stress", "type = \"elastic_stress\"")
      .read("\"acceleration\", \"stress_elastic_gradient\"");
  CaseRun run(text, {"physics.nematic.elastic_constant='0.1 + 0.08 * sin(2 * pi * x / Lx) * cos(2 * pi * y / Ly)'"});
  double largest = 0.0;
  double difference = 0.0;
  for (int a = 0; a < 2; ++a) {
    const auto force = run.field("acceleration", a);
    const auto first = run.field("stress_elastic_gradient", (a * 2 + 0) * 2 + 0);
    const auto second = run.field("stress_elastic_gradient", (a * 2 + 1) * 2 + 1);
    for (std::size_t n = 0; n < force.size(); ++n) {
      largest = std::max(largest, std::abs(force[n]));
      difference = std::max(difference, std::abs(force[n] - first[n] - second[n]));
    }
  }
  EXPECT_LT(difference, 0.03 * largest);
}

// What is fed only later is not taken for nothing.
// A formula that gives no number in a wall has a slope in front of it all the same.
TEST(Prescribed, ASlopeLooksAwayFromWhereThereIsNoNumber) {
  CaseText text(length, 40);
  text.section("solids.rim", "shape = \"disc\"\ncentre = [5.0, 5.0]\nradius = 4.0\nfluid = \"inside\"")
      .section("director", "type = \"uniform\"\nangle = 0.0")
      .flow(1.0)
      .nematic(0.4, 0.7, 0.1)
      .section("physics.activity", "type = \"active_stress\"\nactivity = '0.3 * sqrt(16 - (x - 5)^2 - (y - 5)^2)'")
      .read("\"activity_gradient\"");
  CaseRun run(text);
  for (const double slope : run.field("activity_gradient", 0)) EXPECT_TRUE(std::isfinite(slope));
}

TEST(Prescribed, FrictionThatVariesGoesWithAFlowWithoutSound) {
  CaseText text(4.0, 24);
  text.section("physics.flow", "type = \"incompressible\"\ndensity = 1.0\nviscosity = 1.0")
      .section("physics.substrate", "type = \"friction\"\ncoefficient = '1 + 0.5 * sin(2 * pi * x / Lx)'")
      .section("physics.push",
               "type = \"body_force\"\nforce = [0.0, '(1 + 0.5 * sin(2 * pi * x / Lx)) * (1 + 0.3 * "
               "cos(2 * pi * x / Lx)) + (2 * pi / Lx)^2 * 0.3 * cos(2 * pi * x / Lx)']");
  CaseRun run(text);
  run.run_to(12.0);
  const auto x = run.path(0);
  const auto v = run.field("velocity", 1);
  for (std::size_t n = 0; n < x.size(); ++n)
    EXPECT_NEAR(v[n], 1.0 + 0.3 * std::cos(std::numbers::pi / 2.0 * x[n]), 0.005) << x[n];
  EXPECT_NE(
      error_of([&] { CaseRun creeping(text, {"physics.flow.inertia=false"}); }, ExitCode::bad_case)
          .find("a creeping incompressible flow knows friction that is the same everywhere and in all directions"),
      std::string::npos);
}

// Between the times at which the start looks ahead.

}  // namespace
}  // namespace mesogen
