#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "fake_pass_context.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

constexpr double lambda = 0.7;
constexpr double elastic_constant = 0.02;

using Matrix = std::array<std::array<double, 2>, 2>;

Matrix traceless(double a, double b) { return {{{a, b}, {b, -a}}}; }

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j)
      for (std::size_t k = 0; k < 2; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}

Scene scene_with_a_nematic() {
  Scene scene;
  scene.dimension = 2;
  scene.constants = {{"flow_alignment", lambda}, {"elastic_constant", elastic_constant}};
  return scene;
}

// Pi = 2 lambda (Q + I/2)(Q:H) - lambda H (Q + I/2) - lambda (Q + I/2) H + Q H - H Q, written out
TEST(ElasticStress, IsTheFormulaInMatrices) {
  const PhysicsUnderTest elasticity("elastic_stress", {}, scene_with_a_nematic());
  FakePassContext context(1);
  const Matrix q = traceless(0.3, -0.5);
  const Matrix h = traceless(0.2, 0.9);
  context.set("order_tensor", {q[0][0], q[0][1]});
  context.set("molecular_field", {h[0][0], h[0][1]});
  context.set("elastic_stress", {0.0, 0.0, 0.0, 0.0});
  elasticity.run("elastic stress", context);

  const auto contraction = [](const Matrix& a, const Matrix& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j) sum += a[i][j] * b[i][j];
    return sum;
  };
  Matrix raised = q;
  for (std::size_t i = 0; i < 2; ++i) raised[i][i] += 0.5;
  const Matrix h_raised = product(h, raised);
  const Matrix raised_h = product(raised, h);
  const Matrix q_h = product(q, h);
  const Matrix h_q = product(h, q);
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      const double expected = 2.0 * lambda * raised[i][j] * contraction(q, h) - lambda * h_raised[i][j] -
                              lambda * raised_h[i][j] + q_h[i][j] - h_q[i][j];
      EXPECT_NEAR(context.at("elastic_stress", static_cast<int>(2 * i + j)), expected, 1e-15) << i << j;
    }
  }
}

// f = div Pi - (grad Q) : H: d_x Q : H = 2 (1.1 * 0.2 - 0.4 * 0.9) = -0.28, d_y Q : H = 2 (0.6 * 0.2 + 0.8 * 0.9)
// = 1.68
TEST(ElasticStress, ForceIsItsDivergenceAndWhatCarryingTheOrderAlongTakes) {
  const PhysicsUnderTest elasticity("elastic_stress", {}, scene_with_a_nematic());
  FakePassContext context(1);
  // d Pi_ab / d x_c at (a 2 + b) 2 + c: f_x = Pi_xx,x + Pi_xy,y
  context.set("elastic_stress_gradient", {1.0, 1e9, 1e9, 10.0, 100.0, 1e9, 1e9, 1000.0});
  context.set("molecular_field", {0.2, 0.9});
  context.set("order_tensor_gradient", {1.1, 0.6, -0.4, 0.8});  // Q11_x, Q11_y, Q12_x, Q12_y
  context.set("density", {2.0});
  context.set("acceleration", {0.5, 0.25});
  elasticity.run("elastic force", context);
  EXPECT_DOUBLE_EQ(context.at("acceleration", 0), 0.5 + (11.0 + 0.28) / 2.0);
  EXPECT_DOUBLE_EQ(context.at("acceleration", 1), 0.25 + (1100.0 - 1.68) / 2.0);
}

// (2 + |lambda|) |H|, |H| the larger of that at the start and of the bulk's most below its equilibrium, 2 / sqrt(27)
TEST(ElasticStress, PublishesTheStressOfADistortedStart) {
  Scene scene = scene_with_a_nematic();
  scene.constants["bulk_A"] = -1.0;
  scene.constants["bulk_C"] = 0.5;
  scene.initial["order_tensor"].largest = 1.0;
  const Scales ordered = PhysicsUnderTest("elastic_stress", {}, scene).scene().scales;
  EXPECT_NEAR(ordered.passing_stress, 2.7 * 2.0 / std::sqrt(27.0), 1e-15);
  EXPECT_EQ(ordered.stress, 0.0);
  scene.initial["order_tensor"].laplacian = 300.0;
  const Scales distorted = PhysicsUnderTest("elastic_stress", {}, scene).scene().scales;
  EXPECT_NEAR(distorted.passing_stress, 2.7 * 0.02 * 300.0, 1e-14);
}

TEST(ElasticStress, NeedsANematic) {
  try {
    const PhysicsUnderTest alone("elastic_stress", {});
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_case);
    EXPECT_STREQ(error.what(),
                 "elastic_stress needs the 'flow_alignment' of a nematic: add a [physics.*] section with type = "
                 "\"beris_edwards\"");
  }
}

}  // namespace
