#include <gtest/gtest.h>

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

}  // namespace
