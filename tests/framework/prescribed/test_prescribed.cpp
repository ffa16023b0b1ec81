// Numbers that vary in space and time, in whole cases.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "case_run.hpp"
#include "emulated_device.hpp"
#include "error_of.hpp"
#include "png_file.hpp"

namespace mesogen {
namespace {

using test::CaseRun;
using test::CaseText;

constexpr double length = 10.0;

/// An active nematic that is bent, jittered so that nothing is even.
CaseText active(const std::string& activity, const std::string& more_flow = "") {
  CaseText text(length, 40);
  text.section("particles", "spacing = 0.25\narrangement = \"jittered\"\njitter = 0.1\nseed = 3")
      .modes("director", "[[1, 0, 0.3, 0.4], [1, 2, 0.2, 1.1]]")
      .flow(1.0, more_flow)
      .nematic(0.4, 0.7, 0.1)
      .section("physics.activity", "type = \"active_stress\"\nactivity = " + activity)
      .section("physics.substrate", "type = \"friction\"\ncoefficient = 0.5")
      .section("physics.push", "type = \"body_force\"\nforce = [0.1, -0.2]")
      .read("\"acceleration\", \"velocity\", \"order_tensor\"");
  return text;
}

using Settings = std::vector<std::string>;

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

TEST(Prescribed, AnExpressionOfNumbersIsANumber) {
  CaseRun run(active("'0.6 * viscosity'"), {});
  EXPECT_TRUE(run.setup().prescribed.empty());
  EXPECT_EQ(run.setup().scene.constant("activity"), 0.6);
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

TEST(Prescribed, LimitsGoByTheLargestValue) {
  const auto scene = [](const std::string& activity) { return CaseRun(active(activity)).setup().scene; };
  const Scene varying = scene("'-0.3 * (x < 5) + 0.1 * (x > 5)'");
  EXPECT_DOUBLE_EQ(varying.constant("activity"), -0.3);
  EXPECT_EQ(varying.scales.stress, scene("-0.3").scales.stress);
  EXPECT_TRUE(varying.varying.contains("activity"));
  // Also if it comes later.
  EXPECT_DOUBLE_EQ(CaseRun(active("'0.1 + 0.4 * (t > 2)'"), {"time.end=8.0"}).setup().scene.constant("activity"), 0.5);
  EXPECT_DOUBLE_EQ(CaseRun(active("'0.1 + 0.4 * (t > 2)'"), {"time.end=1.0"}).setup().scene.constant("activity"), 0.1);
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

CaseText fuelled(const std::string& fuel) {
  CaseText text = active("'0.3 * solute'");
  text.section("physics.fuel", "type = \"solute\"\ndiffusivity = 0.01\nsource = 2.0\n" + fuel);
  return text;
}

// What is fed only later is not taken for nothing.
TEST(Prescribed, AFieldThatStartsFromNothingMustTellHowMuchItBecomes) {
  EXPECT_NE(error_of([] { CaseRun run(fuelled("")); }, ExitCode::bad_case)
                .find("physics.activity.activity: \"0.3 * solute\" is 0 everywhere at the start, so nothing tells how "
                      "large it gets: let the section of 'solute' tell its largest value, or start it above 0"),
            std::string::npos);
  CaseRun run(fuelled("largest = 0.5"));
  EXPECT_DOUBLE_EQ(run.setup().scene.constant("activity"), 0.15);
  const std::string found = error_of([&] { run.run_to(1.0); }, ExitCode::run_failed);
  EXPECT_NE(found.find("the run broke down: 'activity' is 0.18"), std::string::npos) << found;
  EXPECT_NE(found.find("limits on the step go by the largest value that is found there"), std::string::npos) << found;
}

TEST(Prescribed, TwoNumbersOfANameCannotBothBe) {
  CaseText text = active("0.3");
  text.section("physics.wind", "type = \"body_force\"\nforce = ['0.1 * sin(y)', 0.0]");
  EXPECT_NE(
      error_of([&] { CaseRun run(text); }, ExitCode::bad_case)
          .find("physics.wind.force: varies, and physics.push.force is about the same field, 'body_force': put all "
                "of it into one of the two sections, and remove the other"),
      std::string::npos);
}

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

TEST(Prescribed, FiniteAnchoringNeedsOneElasticConstant) {
  CaseText text(length, 40);
  text.section("solids.rim",
               "shape = \"disc\"\ncentre = [5.0, 5.0]\nradius = 4.0\nfluid = \"inside\"\nanchoring = \"normal\"\n"
               "anchoring_strength = 0.3")
      .section("director", "type = \"uniform\"\nangle = 0.0")
      .flow(1.0)
      .nematic(0.4, 0.7, 0.1);
  EXPECT_NE(
      error_of([&] { CaseRun run(text, {"physics.nematic.elastic_constant='0.1 + 0.01 * x'"}); }, ExitCode::bad_case)
          .find("solids.rim.anchoring_strength: is a strength against an elastic_constant that is the same "
                "everywhere"),
      std::string::npos);
}

// Between the times at which the start looks ahead.
TEST(Prescribed, AValueOutOfBoundsEndsTheRun) {
  CaseRun run(active("0.3"),
              {"physics.substrate.coefficient='1 - 3 * (abs(t - 0.02465) < 0.0002)'", "time.step=0.001"});
  const std::string found = error_of([&] { run.run_steps(40); }, ExitCode::run_failed);
  EXPECT_NE(found.find("the run broke down: 'friction' is -2 at particle "), std::string::npos) << found;
  EXPECT_NE(found.find("Mend physics.substrate.coefficient, or let it be as large"), std::string::npos) << found;
  CaseRun late(active("0.3"),
               {"physics.push.force=['if(abs(t - 0.02465) < 0.0002, sqrt(-1), 0.1)', 0.0]", "time.step=0.001"});
  const std::string cause = error_of([&] { late.run_steps(40); }, ExitCode::run_failed);
  EXPECT_NE(cause.find("'body_force' is "), std::string::npos) << cause;
}

TEST(Prescribed, WhatIsWrongIsToldWithItsPlace) {
  const auto refusal = [](const Settings& settings) {
    return error_of([&] { CaseRun run(active("0.3"), settings); }, ExitCode::bad_case);
  };
  const auto expect = [&](const Settings& settings, const std::string& text) {
    const std::string found = refusal(settings);
    EXPECT_NE(found.find(text), std::string::npos) << found;
  };
  expect({"physics.activity.activity='0.3 * (z < 5)'"},
         "physics.activity.activity: \"0.3 * (z < 5)\": \"z\" is not known");
  expect({"physics.activity.activity='0.3 / (x - x)'"},
         "physics.activity.activity: \"0.3 / (x - x)\" must be finite everywhere, but is inf at (");
  expect({"physics.substrate.coefficient='x - 5'"},
         "physics.substrate.coefficient: \"x - 5\" must be >= 0 kg/(m3 s) everywhere, but is -4.");
  expect({"physics.substrate.coefficient='1 - t'", "time.end=2.0"}, "everywhere, but is -");
  expect({"physics.substrate.coefficient='-viscosity'"}, "\"-viscosity\" must be >= 0 kg/(m3 s) everywhere, but is -1");
  expect({"physics.push.force=['x', 'y', 'x']"}, "physics.push.force: must be a list of 2 numbers");
  expect({"physics.push.force=['x', '1 / (y - y)']"}, "physics.push.force: \"1 / (y - y)\" must be finite everywhere");
  expect(
      {"physics.nematic.elastic_constant='0.1 + 0.01 * x'", "physics.activity.activity='elastic_constant'"},
      "\"elastic_constant\" is prescribed itself, by physics.nematic.elastic_constant: an expression takes constants");
  expect({"physics.nematic.flow_alignment='x'"}, "physics.nematic.flow_alignment: must be a number, but is \"x\"");
  const auto image = [](const std::string& table) { return Settings{"physics.activity.activity=" + table}; };
  expect(image("{ image = 'missing.png', low = 0.0, high = 1.0 }"), "\"missing.png\" cannot be read");
  expect(image("{ image = 'a.png', high = 1.0 }"),
         "low must be given: write { image = \"mask.png\", low = 0.0, high = 1.0 }");
  expect(image("{ image = 'a.png', low = 0.0, hihg = 1.0 }"), "unknown key \"hihg\"; did you mean \"high\"?");
  expect(image("{ image = ['a.png', 'b.png'], low = 0.0, high = 1.0 }"), "2 images need as many times");
  expect(image("{ image = ['a.png', 'b.png'], low = 0.0, high = 1.0, times = [1.0, 1.0] }"),
         "times must rise, but 1 comes after 1");
  expect(image("{ image = ['a.png', 'b.png'], low = 0.0, high = 1.0, times = [1.0] }"),
         "times must be as many as the images, 2, but are 1");
  expect(image("{ image = 3, low = 0.0, high = 1.0 }"),
         "image must be the name of a PNG file, or a list of such, but is 3");
}

}  // namespace
}  // namespace mesogen
