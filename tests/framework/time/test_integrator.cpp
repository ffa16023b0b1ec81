// The two time schemes against exact solutions of what depends on the field itself.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "case_run.hpp"

namespace {

using namespace mesogen::test;

/// `scheme`: of explicit steps, or "stabilised".
CaseText in_time(CaseText text, const std::string& scheme, double step) {
  const std::string keys =
      scheme == "stabilised" ? "stepping = \"stabilised\"" : "stepping = \"explicit\"\nscheme = \"" + scheme + "\"";
  text.section("time", "end = 1e6\n" + keys + "\nstep = " + std::to_string(step));
  return text;
}

/// q' = Gamma q (1 - q^2) at A = -1, C = 1/2: q^2 = 1 / (1 + (1 / q0^2 - 1) exp(-2 Gamma t)).
double error_of_relaxation(const std::string& scheme, double step) {
  constexpr double gamma = 0.4;
  constexpr double start = 0.2;
  constexpr double end = 5.0;
  CaseText text(10.0, 12);
  text.section("director", "type = \"modes\"\nmodes = []\norder = 0.2").nematic(gamma, 0.7, 0.02);
  CaseRun run(in_time(text, scheme, step));
  run.run_to(end);
  const double exact = 1.0 / std::sqrt(1.0 + (1.0 / (start * start) - 1.0) * std::exp(-2.0 * gamma * end));
  return std::abs(std::hypot(run.field("order_tensor", 0)[0], run.field("order_tensor", 1)[0]) - exact);
}

/// u' = -f u / rho
double error_of_friction(const std::string& scheme, double step) {
  constexpr double end = 4.0;
  CaseText text(10.0, 12);
  text.section("velocity", "type = \"uniform\"\nvalue = [1.0, 0.0]")
      .flow(0.1, "sound_speed = 1.0")
      .section("physics.friction", "type = \"friction\"\ncoefficient = 0.5");
  CaseRun run(in_time(text, scheme, step));
  run.run_to(end);
  return std::abs(run.field("velocity", 0)[0] - std::exp(-0.5 * end));
}

TEST(TimeScheme, MidpointIsOfSecondOrder) {
  EXPECT_NEAR(std::log2(error_of_relaxation("midpoint", 0.2) / error_of_relaxation("midpoint", 0.1)), 2.0, 0.3);
  EXPECT_NEAR(std::log2(error_of_friction("midpoint", 0.2) / error_of_friction("midpoint", 0.1)), 2.0, 0.3);
}

TEST(TimeScheme, StabilisedStepsAreOfSecondOrder) {
  EXPECT_NEAR(std::log2(error_of_relaxation("stabilised", 0.2) / error_of_relaxation("stabilised", 0.1)), 2.0, 0.3);
  EXPECT_NEAR(std::log2(error_of_friction("stabilised", 0.4) / error_of_friction("stabilised", 0.2)), 2.0, 0.3);
}

TEST(TimeScheme, HalfStepsAreOfFirstOrderForWhatDependsOnItself) {
  EXPECT_NEAR(std::log2(error_of_relaxation("half_steps", 0.2) / error_of_relaxation("half_steps", 0.1)), 1.0, 0.3);
  EXPECT_NEAR(std::log2(error_of_friction("half_steps", 0.2) / error_of_friction("half_steps", 0.1)), 1.0, 0.3);
}

}  // namespace
