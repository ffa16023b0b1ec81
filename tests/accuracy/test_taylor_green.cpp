// Taylor-Green vortices at Re = U L / nu = 100: speeds decay as exp(-8 pi^2 nu t / L^2). The hardest plain flow for
// particles: they are stretched along the stagnation points, and without the shift they clump by t = 0.3 L / U.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "case_run.hpp"

namespace {

using namespace mesogen::test;

constexpr double pi = std::numbers::pi;
constexpr double viscosity = 0.01;
constexpr double end = 0.4;

CaseText vortices(int across, const std::string& more = "") {
  CaseText text(1.0, across);
  // psi = U L / (2 pi) cos(2 pi x / L) cos(2 pi y / L) with U = L = 1: mean square speed U^2 / 2
  text.modes("velocity", "[[1, 1, 0.079577471545947673, 0.0], [1, -1, 0.079577471545947673, 0.0]]")
      .flow(viscosity, "sound_speed = 10.0\n" + more)
      .read("\"velocity\", \"velocity_gradient\", \"volume\"");
  return text;
}

double error_of_speed(int across) {
  CaseRun run(vortices(across));
  EXPECT_NEAR(run.observe("flow_statistics", "v_rms"), std::sqrt(0.5), 1e-12);
  run.run_to(end);
  return run.observe("flow_statistics", "v_rms") / (std::sqrt(0.5) * std::exp(-8.0 * pi * pi * viscosity * end)) - 1.0;
}

TEST(TaylorGreen, DecaysAtTheExactRate) {
  const double coarse = error_of_speed(40);
  const double fine = error_of_speed(80);
  EXPECT_LT(std::abs(coarse), 0.004);
  EXPECT_LT(std::abs(fine), 0.002);
}

TEST(TaylorGreen, ShiftKeepsParticlesSpread) {
  CaseRun run(vortices(50));
  run.run_to(end);
  EXPECT_GT(run.observe("flow_statistics", "min_spacing"), 0.4);
  EXPECT_GT(run.observe("flow_statistics", "volume_min"), 0.8);
  EXPECT_LT(run.observe("flow_statistics", "volume_max"), 1.2);
}

TEST(TaylorGreen, ParticlesClumpWithoutTheShift) {
  CaseRun run(vortices(50, "shift = 0.0"));
  try {
    run.run_to(end);
    FAIL() << "the shift is not needed?";
  } catch (const mesogen::Error& error) {
    EXPECT_EQ(error.code(), mesogen::ExitCode::run_failed);
    // Which guard is the first to see it differs with the instruction set.
    const std::string text = error.what();
    EXPECT_TRUE(text.find("the run broke down: 'compression' is ") != std::string::npos ||
                text.find("the run ran away: the largest speed, ") != std::string::npos)
        << text;
    EXPECT_GT(run.time(), 0.2);
  }
}

}  // namespace
