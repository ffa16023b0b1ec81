#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "fake_pass_context.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

constexpr double pi = std::numbers::pi;

/// Rates of angle and order of one particle.
struct Rates {
  double angle, order;
};

/// `gradient`: (du/dx, du/dy, dv/dx, dv/dy). No bulk or elastic forces unless given.
Rates rates(double order, double angle, double flow_alignment, const std::array<double, 4>& gradient,
            double bulk_a = 0.0, double bulk_c = 0.0) {
  const PhysicsUnderTest nematic("beris_edwards", {{"rotational_diffusivity", 0.4},
                                                   {"flow_alignment", flow_alignment},
                                                   {"elastic_constant", 0.0},
                                                   {"bulk.A", bulk_a},
                                                   {"bulk.C", bulk_c}});
  FakePassContext context(1);
  const double q11 = order * std::cos(2.0 * angle);
  const double q12 = order * std::sin(2.0 * angle);
  context.set("order_tensor", {q11, q12});
  context.set("order_tensor_laplacian", {0.0, 0.0});
  context.set("velocity_gradient", {gradient.begin(), gradient.end()});
  context.set("order_tensor_rate", {0.0, 0.0});
  nematic.run("rate of the order tensor", context);
  const double rate11 = context.at("order_tensor_rate", 0);
  const double rate12 = context.at("order_tensor_rate", 1);
  return {(q11 * rate12 - q12 * rate11) / (2.0 * order * order), (q11 * rate11 + q12 * rate12) / order};
}

// u = w0 (-y, x)
TEST(BerisEdwards, RigidRotationTurnsTheDirectorWithTheFluid) {
  for (const double angle : {0.0, 0.7, 2.0}) {
    const Rates found = rates(0.8, angle, 0.7, {0.0, -0.3, 0.3, 0.0});
    EXPECT_NEAR(found.angle, 0.3, 1e-15);
    EXPECT_NEAR(found.order, 0.0, 1e-15);
  }
}

// u = g y: theta' = -g/2 + lambda g cos(2 theta) / (4 q)
TEST(BerisEdwards, ShearTurnsTheDirectorAsKnown) {
  constexpr double g = 0.5;
  for (const double lambda : {0.7, -0.7, 3.0}) {
    for (const double order : {0.4, 1.0}) {
      for (double angle = -1.5; angle < 1.6; angle += 0.25) {
        EXPECT_NEAR(rates(order, angle, lambda, {0.0, g, 0.0, 0.0}).angle,
                    -g / 2.0 + lambda * g * std::cos(2.0 * angle) / (4.0 * order), 1e-15);
      }
    }
  }
}

TEST(BerisEdwards, FlowAligningNematicStandsStillAtItsAngle) {
  constexpr double order = 0.8;
  constexpr double lambda = 2.0;
  const double steady = 0.5 * std::acos(2.0 * order / lambda);
  EXPECT_NEAR(rates(order, steady, lambda, {0.0, 0.5, 0.0, 0.0}).angle, 0.0, 1e-15);
  // It returns from either side: this of the two angles is the stable one.
  EXPECT_LT(rates(order, steady + 0.1, lambda, {0.0, 0.5, 0.0, 0.0}).angle, 0.0);
  EXPECT_GT(rates(order, steady - 0.1, lambda, {0.0, 0.5, 0.0, 0.0}).angle, 0.0);
}

// With b = lambda / (2 q) < 1 the director never rests; a half turn takes 2 pi / (g sqrt(1 - b^2)).
TEST(BerisEdwards, TumblesWithTheKnownPeriod) {
  constexpr double order = 1.0;
  constexpr double lambda = 0.7;
  constexpr double g = 0.5;
  constexpr int steps = 20000;
  const double b = lambda / (2.0 * order);
  const double period = 2.0 * pi / (g * std::sqrt(1.0 - b * b));
  const double dt = period / steps;
  const auto slope = [&](double angle) { return rates(order, angle, lambda, {0.0, g, 0.0, 0.0}).angle; };
  double angle = 0.3;
  for (int n = 0; n < steps; ++n) angle += dt * slope(angle + dt / 2.0 * slope(angle));
  EXPECT_NEAR(angle, 0.3 - pi, 1e-5);
}

// Along the stretching axis of a pure strain, u = e (x, -y), order grows; across it falls.
TEST(BerisEdwards, StrainRaisesOrderAlongIt) {
  const double e = 0.2;
  const double lambda = 0.7;
  const double q = 0.5;
  const double expected = lambda * e * (1.0 - 4.0 * q * q);
  EXPECT_NEAR(rates(q, 0.0, lambda, {e, 0.0, 0.0, -e}).order, expected, 1e-15);
  EXPECT_GT(rates(0.2, 0.0, lambda, {e, 0.0, 0.0, -e}).order, 0.0);
  EXPECT_LT(rates(0.2, pi / 2.0, lambda, {e, 0.0, 0.0, -e}).order, 0.0);
}

// A weakly compressible flow has a little divergence: it is no strain.
TEST(BerisEdwards, DivergenceAloneChangesNothing) {
  const Rates found = rates(0.7, 0.4, 0.7, {0.1, 0.0, 0.0, 0.1});
  EXPECT_EQ(found.angle, 0.0);
  EXPECT_EQ(found.order, 0.0);
}

TEST(BerisEdwards, BulkDrivesOrderToTheRootOfMinusAOverTwoC) {
  const auto drive = [](double order) { return rates(order, 0.3, 0.7, {}, -2.0, 1.5).order; };
  const double equilibrium = std::sqrt(2.0 / (2.0 * 1.5));
  EXPECT_NEAR(drive(equilibrium), 0.0, 1e-15);
  EXPECT_NEAR(drive(0.5), 0.4 * (2.0 - 2.0 * 1.5 * 0.25) * 0.5, 1e-15);  // Gamma (-A - 2 C q^2) q
  EXPECT_GT(drive(equilibrium - 0.1), 0.0);
  EXPECT_LT(drive(equilibrium + 0.1), 0.0);
}

TEST(BerisEdwards, MolecularFieldIsTheForceOfTheFreeEnergy) {
  const PhysicsUnderTest nematic(
      "beris_edwards", {{"rotational_diffusivity", 0.4}, {"flow_alignment", 0.7}, {"elastic_constant", 0.02}});
  FakePassContext context(1);
  context.set("order_tensor", {0.3, -0.4});  // Tr Q^2 = 0.5; A = -1, C = 1/2
  context.set("order_tensor_laplacian", {2.0, 5.0});
  context.set("molecular_field", {0.0, 0.0});
  nematic.run("molecular field", context);
  EXPECT_NEAR(context.at("molecular_field", 0), 0.75 * 0.3 + 0.02 * 2.0, 1e-15);
  EXPECT_NEAR(context.at("molecular_field", 1), -0.75 * 0.4 + 0.02 * 5.0, 1e-15);
}

TEST(BerisEdwards, LimitsTheStep) {
  const PhysicsUnderTest nematic(
      "beris_edwards", {{"rotational_diffusivity", 0.4}, {"flow_alignment", 0.7}, {"elastic_constant", 0.02}});
  Scene scene;
  scene.dimension = 2;
  scene.diffusion_step = 0.005;
  const auto limits = nematic.limits(scene);
  EXPECT_NEAR(limits.at("elasticity: stable diffusion by Gamma K"), 0.005 / 0.008, 1e-12);
  EXPECT_NEAR(limits.at("bulk relaxation: 0.4 / (Gamma (|A| + 6 C))"), 0.4 / (0.4 * 4.0), 1e-12);
}

}  // namespace
