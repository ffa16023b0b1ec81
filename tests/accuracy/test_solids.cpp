// Fluid and nematic between solids against exact solutions.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "case_run.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

std::string text_of(double number) { return std::to_string(number); }

/// A box that is `across` spacings wider than what it holds, with a disc in its middle.
CaseText dish(double radius, int across, const std::string& more) {
  const double spacing = radius / across;
  const int particles = 2 * across + 10;
  const double size = particles * spacing;
  CaseText text(size, particles);
  text.section("solids.rim", "shape = \"disc\"\ncentre = [" + text_of(size / 2) + ", " + text_of(size / 2) +
                                 "]\nradius = " + text_of(radius) + "\nfluid = \"inside\"\n" + more);
  return text;
}

/// Relative error (L2) of the flow between discs of 2 and 4 m, of which the outer one turns: u = a r + b / r.
double couette_error(int across) {
  CaseText text = dish(4.0, 2 * across, "angular_velocity = 0.1");
  const double centre = (4 * across + 10) * 2.0 / across / 2.0;
  text.section("solids.inner",
               "shape = \"disc\"\ncentre = [" + text_of(centre) + ", " + text_of(centre) + "]\nradius = 2.0")
      .flow(0.5);
  CaseRun run(text);
  run.run_to(8.0);
  const auto x = run.path(0);
  const auto y = run.path(1);
  const auto u = run.field("velocity", 0);
  const auto v = run.field("velocity", 1);
  const double b = -0.1 / (1.0 / 4.0 - 1.0 / 16.0);
  const double a = -b / 4.0;
  double error = 0.0;
  double exact = 0.0;
  for (std::size_t n = 0; n < x.size(); ++n) {
    const double rate = a + b / (std::pow(x[n] - centre, 2) + std::pow(y[n] - centre, 2));
    error += std::pow(u[n] + rate * (y[n] - centre), 2) + std::pow(v[n] - rate * (x[n] - centre), 2);
    exact += rate * rate * (std::pow(x[n] - centre, 2) + std::pow(y[n] - centre, 2));
  }
  return std::sqrt(error / exact);
}

TEST(BetweenSolids, TheFlowBetweenTurningDiscsIsOfSecondOrder) {
  const double coarse = couette_error(8);
  const double fine = couette_error(16);
  EXPECT_LT(fine, 2e-3);
  EXPECT_GT(std::log2(coarse / fine), 1.5) << coarse << ", " << fine;
}

/// Largest error of Q = (r / R)^2 (cos 2 phi, sin 2 phi), that of a nematic without bulk energy in a dish that anchors
/// it normally.
double dish_error(int across) {
  CaseText text = dish(4.0, across, "anchoring = \"normal\"");
  const double centre = (2 * across + 10) * 4.0 / across / 2.0;
  text.section("director", "type = \"uniform\"\norder = 0.5")
      .section("physics.nematic",
               "type = \"beris_edwards\"\nrotational_diffusivity = 0.5\nflow_alignment = 0.7\n"
               "elastic_constant = 0.4\nbulk = { A = 0.0, C = 0.0 }");
  CaseRun run(text);
  run.run_to(120.0);
  const auto x = run.path(0);
  const auto y = run.path(1);
  const auto q11 = run.field("order_tensor", 0);
  const auto q12 = run.field("order_tensor", 1);
  double largest = 0.0;
  for (std::size_t n = 0; n < x.size(); ++n) {
    const double dx = x[n] - centre;
    const double dy = y[n] - centre;
    largest =
        std::max({largest, std::abs(q11[n] - (dx * dx - dy * dy) / 16.0), std::abs(q12[n] - 2.0 * dx * dy / 16.0)});
  }
  return largest;
}

TEST(BetweenSolids, TheNematicInADishIsOfSecondOrder) {
  const double coarse = dish_error(12);
  const double fine = dish_error(24);
  EXPECT_LT(fine, 2e-3);
  EXPECT_GT(std::log2(coarse / fine), 1.5) << coarse << ", " << fine;
}

// Tangential anchoring turns the director once around along the rim: +1/2 defects outnumber -1/2 ones by two, always.
TEST(BetweenSolids, AnActiveDishHoldsTheChargeOfItsRim) {
  CaseText text = dish(4.0, 30, "anchoring = \"tangential\"");
  text.flow(1.0).nematic(0.4, 0.7, 0.1).active(0.4).section("director", "type = \"perturbed\"\namplitude = 0.3");
  text.read("\"order_tensor\"");
  CaseRun run(text);
  for (double time = 5.0; time <= 40.0; time += 5.0) {
    run.run_to(time);
    EXPECT_EQ(run.observe("defects", "count_plus") - run.observe("defects", "count_minus"), 2.0) << "at " << time;
  }
}

// Elasticity drives a flow until the nematic has settled, and none afterwards. Stress x size / viscosity is 4 m/s.
TEST(BetweenSolids, APassiveNematicInAPolygonComesToRest) {
  CaseText text(5.0, 25);
  text.section("solids.rim",
               "shape = \"polygon\"\npoints = [[0.5, 0.5], [4.5, 0.5], [4.5, 4.5], [2.5, 3.5], [0.5, 4.5]]\n"
               "fluid = \"inside\"\nanchoring = \"tangential\"")
      .flow(1.0)
      .section("physics.nematic",
               "type = \"beris_edwards\"\nrotational_diffusivity = 4.0\nflow_alignment = 0.7\n"
               "elastic_constant = 0.1\nbulk = { A = -1.0, C = 0.5 }")
      .section("physics.elasticity", "type = \"elastic_stress\"")
      .section("director", "type = \"perturbed\"\namplitude = 0.6\nseed = 4");
  CaseRun run(text);
  run.run_to(2.0);
  EXPECT_GT(run.observe("flow_statistics", "v_rms"), 1e-3);
  run.run_to(24.0);
  EXPECT_LT(run.observe("flow_statistics", "v_rms"), 1e-6);
}

// Between a wall that holds Q12 = 0 strongly and one that pulls it to 1 with W: Q12 = y / (H + K / W), a slip of
// (K / W) / (H + K / W) at the second.
TEST(BetweenSolids, WeakAnchoringLetsTheNematicSlip) {
  CaseText text(2.0, 40);
  text.section("solids.floor",
               "shape = \"box\"\ncentre = [1.0, 0.2]\nsize = [6.0, 0.6]\nanchoring = \"tangential\"\norder = 0.0")
      .section("solids.roof",
               "shape = \"box\"\ncentre = [1.0, 1.8]\nsize = [6.0, 0.6]\nanchoring = \"angle\"\nangle = 45.0\n"
               "anchoring_strength = 1.0")
      .section("director", "type = \"uniform\"\norder = 0.1")
      .section("physics.nematic",
               "type = \"beris_edwards\"\nrotational_diffusivity = 1.0\nflow_alignment = 0.7\n"
               "elastic_constant = 0.3\nbulk = { A = 0.0, C = 0.0 }");
  CaseRun run(text);
  run.run_to(20.0);
  const auto y = run.path(1);
  const auto q12 = run.field("order_tensor", 1);
  for (std::size_t n = 0; n < y.size(); ++n) EXPECT_NEAR(q12[n], (y[n] - 0.5) / 1.3, 0.02 * 0.3 / 1.3) << "at " << y[n];
}

// Two defects of small cores in a passive disc settle opposite each other at 5^(-1/4) R (Duclos et al., Nature Physics
// 13, 58 (2017)). Cores of R / 30.
TEST(BetweenSolidsLong, TwoDefectsSettleWhereTheyRepelEachOtherAndTheRim) {
  CaseText text = dish(1.0, 60, "anchoring = \"tangential\"");
  text.section("director", "type = \"uniform\"\nangle = 20.0")
      .section("physics.nematic",
               "type = \"beris_edwards\"\nrotational_diffusivity = 1.0\nflow_alignment = 0.0\nelastic_constant = " +
                   text_of(1.0 / 900.0) + "\nbulk = { A = -1.0, C = 0.5 }")
      .read("\"order_tensor\"");
  CaseRun run(text);
  run.run_to(1200.0);
  const double centre = (60 + 5) / 60.0;
  const auto defects = run.sample("defects").values().at("defects");
  ASSERT_EQ(defects.size(), 8U);
  for (std::size_t n = 0; n < defects.size(); n += 4) {
    EXPECT_EQ(defects[n + 2], 0.5);
    EXPECT_NEAR(std::hypot(defects[n] - centre, defects[n + 1] - centre), std::pow(5.0, -0.25), 0.03 * 0.669);
  }
}

}  // namespace
