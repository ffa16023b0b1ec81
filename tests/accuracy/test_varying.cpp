// Numbers that vary in space and time, substances and friction with a direction, against exact solutions.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "case_run.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

constexpr double length = 4.0;
const double wave = 2.0 * std::numbers::pi / length;

/// A slow, viscous flow on a lattice, driven from rest.
CaseText driven(const std::string& friction, const std::string& force, const std::string& stepping) {
  CaseText text(length, 32);
  text.section("time", "end = 1e6\nstepping = \"" + stepping + "\"")
      .flow(1.0)
      .section("physics.substrate", friction)
      .section("physics.push", "type = \"body_force\"\nforce = " + force);
  return text;
}

// mu v'' - xi(x) v + f(x) = 0 with v = 1 + 0.3 cos(k x) and xi = 1 + 0.5 sin(k x).
TEST(Varying, FrictionAndForceHoldTheExactFlow) {
  const std::string cosine = "0.3 * cos(2 * pi * x / Lx)";
  const std::string force =
      "[0.0, '(1 + 0.5 * sin(2 * pi * x / Lx)) * (1 + " + cosine + ") + viscosity * (2 * pi / Lx)^2 * " + cosine + "']";
  for (const char* const stepping : {"explicit", "stabilised"}) {
    CaseRun run(driven("type = \"friction\"\ncoefficient = '1 + 0.5 * sin(2 * pi * x / Lx)'", force, stepping));
    run.run_to(12.0);
    const auto x = run.path(0);
    const auto v = run.field("velocity", 1);
    for (std::size_t n = 0; n < x.size(); ++n)
      EXPECT_NEAR(v[n], 1.0 + 0.3 * std::cos(wave * x[n]), 0.005) << stepping << ", " << x[n];
  }
}

// A force that turns: rho du/dt = f - xi u has u = f0 / sqrt(xi^2 + (rho w)^2) once the start is forgotten.
TEST(Varying, AForceInTimeHasTheRightPhase) {
  for (const char* const stepping : {"explicit", "stabilised"}) {
    CaseRun run(driven("type = \"friction\"\ncoefficient = 2.0", "['0.4 * cos(3 * t)', '0.4 * sin(3 * t)']", stepping));
    run.run_to(8.0);
    const double lag = std::atan2(3.0, 2.0);
    const double speed = 0.4 / std::sqrt(13.0);
    EXPECT_NEAR(run.field("velocity", 0).front(), speed * std::cos(24.0 - lag), 0.01 * speed) << stepping;
    EXPECT_NEAR(run.field("velocity", 1).front(), speed * std::sin(24.0 - lag), 0.01 * speed) << stepping;
  }
}

// f at 45 degrees to the axis: u = (f / xi_along, f / xi_across).
TEST(Varying, FrictionWithADirectionLetsTheFlowTurn) {
  for (const char* const stepping : {"explicit", "stabilised"})
    for (const auto& [along, across] : {std::pair(1.0, 4.0), std::pair(4.0, 1.0)}) {
      CaseRun run(driven("type = \"anisotropic_friction\"\nalong = " + std::to_string(along) +
                             "\nacross = " + std::to_string(across) + "\naxis = 90.0",
                         "[0.2, 0.2]", stepping));
      run.run_to(10.0);
      EXPECT_NEAR(run.field("velocity", 0).front(), 0.2 / across, 0.001) << stepping;
      EXPECT_NEAR(run.field("velocity", 1).front(), 0.2 / along, 0.001) << stepping;
    }
}

// c = s/k + (c0 - s/k) exp(-k t) + a exp(-(k + D q^2) t) cos(q x), q the wave number.
TEST(Varying, ASoluteDiffusesAndDecaysAsItShould) {
  CaseText text(length, 32);
  text.flow(1.0)
      .section("physics.fuel",
               "type = \"solute\"\ndiffusivity = 0.1\nsource = '0.2 + 0.1 * cos(2 * pi * x / Lx)'\n"
               "decay = 0.5")
      .section("solute_spots", "background = 1.0");
  CaseRun run(text);
  run.run_to(2.0);
  const auto x = run.path(0);
  const auto c = run.field("solute");
  const double rate = 0.5 + 0.1 * wave * wave;
  for (std::size_t n = 0; n < x.size(); ++n) {
    const double mean = 0.4 + 0.6 * std::exp(-1.0);
    const double amplitude = 0.1 / rate * (1.0 - std::exp(-2.0 * rate));
    EXPECT_NEAR(c[n], mean + amplitude * std::cos(wave * x[n]), 5e-4) << x[n];
  }
}

/// An active nematic whose director is bent.
CaseText active(const std::string& activity) {
  CaseText text(length, 32);
  text.modes("director", "[[1, 0, 0.3, 0.4]]")
      .flow(1.0)
      .nematic(0.4, 0.7, 0.1)
      .section("physics.fuel", "type = \"solute\"\ndiffusivity = 0.0\nsource = 0.0")
      .section("solute_spots", "background = 0.5\nspots = [[2.0, 2.0, 0.8, 0.5]]")
      .section("physics.activity", "type = \"active_stress\"\nactivity = " + activity)
      .read("\"acceleration\", \"activity\"");
  return text;
}

// Its gradient comes from the particles where a field says what it is, and from the formula where place does.
TEST(Varying, ASoluteFeedsTheActivity) {
  CaseRun by_solute(active("'0.4 * solute'"));
  CaseRun by_place(active("'0.4 * (0.5 + 0.5 * exp(-((x - 2)^2 + (y - 2)^2) / 0.64))'"));
  const auto value = by_solute.field("activity");
  const auto expected = by_place.field("activity");
  double largest = 0.0;
  double difference = 0.0;
  const auto push = by_place.field("acceleration", 1);
  const auto found = by_solute.field("acceleration", 1);
  for (std::size_t n = 0; n < value.size(); ++n) {
    EXPECT_NEAR(value[n], expected[n], 1e-12);
    largest = std::max(largest, std::abs(push[n]));
    difference = std::max(difference, std::abs(push[n] - found[n]));
  }
  EXPECT_LT(difference, 0.03 * largest);
  EXPECT_NEAR(by_solute.setup().scene.constant("activity"), 0.4, 0.01);
}

}  // namespace
