#include <gtest/gtest.h>

#include <cmath>

#include "case_run.hpp"

namespace {

using namespace mesogen::test;

// In a periodic box nothing holds the fluid back: u = f t / rho, the same everywhere.
TEST(BodyForce, AcceleratesAFreeFluidByForceOverDensity) {
  CaseText text(1.0, 16);
  text.flow(0.1).section("physics.drive", "type = \"body_force\"\nforce = [0.25, -0.5]");
  CaseRun run(text);
  run.run_to(0.01);
  for (const double u : run.field("velocity", 0)) EXPECT_NEAR(u, 0.0025, 1e-12);
  for (const double v : run.field("velocity", 1)) EXPECT_NEAR(v, -0.005, 1e-12);
}

// At rest the pressure falls by f L from wall to wall: the sound is chosen by that, and the density varies by as little
// as it may. Along a periodic axis nothing is compressed.
TEST(BodyForce, PressesAgainstWalls) {
  CaseText text(2.0, 20);
  text.section("domain", "size = [2.0, 2.0]\nboundary = { type = \"walls\", axes = [\"y\"] }")
      .flow(0.1)
      .section("physics.drive", "type = \"body_force\"\nforce = [3.0, -0.5]");
  CaseRun run(text);
  EXPECT_EQ(run.state().scene.scales.stress, 1.0);
  run.run_to(0.5);
  for (const double c : run.field("compression")) EXPECT_LT(std::abs(c), 0.02);
}

}  // namespace
