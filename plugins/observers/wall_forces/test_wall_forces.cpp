#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "case_run.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

const std::string all = R"("pressure", "stress_viscous", "stress_active", "stress_elastic")";

std::vector<double> quantity(CaseRun& run, const std::string& name) {
  return run.sample("wall_forces").values().at(name);
}

/// Sets a field by a function of place.
template <class Function>
void set(CaseRun& run, const std::string& name, const Function& value) {
  Field& field = run.state().fields.at(name);
  const auto& position = run.state().particles.position;
  for (Index i = 0; i < run.state().particles.count(); ++i) {
    const auto n = static_cast<std::size_t>(i);
    for (int c = 0; c < field.components(); ++c)
      field.set(c, i, value(c, position[0].host()[n], position[1].host()[n]));
  }
  ++field.version;
}

CaseText pillar() {
  CaseText text(2.0, 40);
  text.section("solids.pillar", "shape = \"disc\"\ncentre = [0.8, 1.1]\nradius = 0.4")
      .flow(0.3)
      .read("\"pressure\", \"stress_viscous\"");
  return text;
}

TEST(WallForces, KnowTheLengthOfASurface) {
  CaseRun run(pillar());
  EXPECT_NEAR(quantity(run, "length")[0] / (0.8 * std::numbers::pi), 1.0, 2e-3);
  CaseText channel(2.0, 20);
  channel.boundary("walls").flow(0.3).read("\"pressure\", \"stress_viscous\"");
  CaseRun between(channel);
  EXPECT_EQ(between.setup().scene.surfaces.size(), 2U);
  EXPECT_EQ(between.setup().scene.surfaces[1].name, "y_high");
  EXPECT_NEAR(quantity(between, "length")[1], 2.0, 1e-12);
}

// A pressure p = a x pushes with minus its gradient times the volume of the pillar.
TEST(WallForces, OfALinearPressureAreThoseOnTheVolume) {
  CaseRun run(pillar());
  set(run, "pressure", [](int, double x, double y) { return 2.0 * x - y; });
  const double area = 0.16 * std::numbers::pi;
  const auto force = quantity(run, "pressure_force");
  EXPECT_NEAR(force[0], -2.0 * area, 5e-3 * area);
  EXPECT_NEAR(force[1], 1.0 * area, 5e-3 * area);
  EXPECT_NEAR(quantity(run, "torque")[0], 0.0, 1e-3 * area);
}

/// Torque of the fluid on a pillar that turns in a vortex u = b / r, over its exact value, -4 pi mu b.
double torque_of_vortex(int across) {
  CaseText text(2.0, across);
  text.section("solids.pillar", "shape = \"disc\"\ncentre = [0.8, 1.1]\nradius = 0.4\nangular_velocity = 6.25")
      .flow(0.3)
      .read("\"pressure\", \"stress_viscous\"");
  CaseRun run(text);
  set(run, "velocity", [](int c, double x, double y) {
    const double square = (x - 0.8) * (x - 0.8) + (y - 1.1) * (y - 1.1);
    return (c == 0 ? 1.1 - y : x - 0.8) / square;
  });
  EXPECT_NEAR(quantity(run, "viscous_force")[0], 0.0, 0.02);
  return quantity(run, "torque")[0] / (-4.0 * std::numbers::pi * 0.3);
}

TEST(WallForces, OfAVortexHoldThePillarBack) {
  const double coarse = std::abs(torque_of_vortex(40) - 1.0);
  const double fine = std::abs(torque_of_vortex(80) - 1.0);
  EXPECT_LT(fine, 0.02);
  EXPECT_GT(coarse / fine, 2.8);  // second order
}

// Once steady, a stream leaves its whole push on a pillar.
TEST(WallForces, OfAStreamBalanceTheBodyForce) {
  CaseText text(2.0, 50);
  text.section("solids.pillar", "shape = \"disc\"\ncentre = [1.0, 1.0]\nradius = 0.3")
      .flow(0.5)
      .section("physics.push", "type = \"body_force\"\nforce = [0.5, 0.0]")
      .read("\"pressure\", \"stress_viscous\"");
  CaseRun run(text);
  run.run_to(8.0);
  const double push = 0.5 * run.setup().scene.fluid_volume;
  EXPECT_NEAR(quantity(run, "force")[0] / push, 1.0, 0.02);
  EXPECT_NEAR(quantity(run, "force")[1] / push, 0.0, 0.02);
}

// Once steady, the force on both walls of a channel is that of the body force on the fluid: 1/2 each.
TEST(WallForces, OfAChannelBalanceTheBodyForce) {
  CaseText text(1.0, 24);
  text.boundary("walls")
      .flow(0.5)
      .section("physics.push", "type = \"body_force\"\nforce = [0.8, 0.0]")
      .read("\"pressure\", \"stress_viscous\"");
  CaseRun run(text);
  run.run_to(2.5);
  const auto force = quantity(run, "force");
  EXPECT_NEAR(force[0], 0.4, 0.005 * 0.4);
  EXPECT_NEAR(force[2], 0.4, 0.005 * 0.4);
}

}  // namespace
