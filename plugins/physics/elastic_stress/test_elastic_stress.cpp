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
  scene.constants = {{"flow_alignment", lambda}, {"elastic_constant", elastic_constant}};
  return scene;
}

// Pi = 2 lambda (Q + I/2)(Q:H) - lambda H (Q + I/2) - lambda (Q + I/2) H - K d_i Q : d_j Q + Q H - H Q, written out
TEST(ElasticStress, IsTheFormulaInMatrices) {
  const PhysicsUnderTest elasticity("elastic_stress", {}, scene_with_a_nematic());
  FakePassContext context(1);
  const Matrix q = traceless(0.3, -0.5);
  const Matrix h = traceless(0.2, 0.9);
  const Matrix q_x = traceless(1.1, -0.4);
  const Matrix q_y = traceless(0.6, 0.8);
  context.set("order_tensor", {q[0][0], q[0][1]});
  context.set("molecular_field", {h[0][0], h[0][1]});
  context.set("order_tensor_gradient", {q_x[0][0], q_y[0][0], q_x[0][1], q_y[0][1]});
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
  const std::array<Matrix, 2> slope = {q_x, q_y};
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      const double expected = 2.0 * lambda * raised[i][j] * contraction(q, h) - lambda * h_raised[i][j] -
                              lambda * raised_h[i][j] - elastic_constant * contraction(slope[i], slope[j]) + q_h[i][j] -
                              h_q[i][j];
      EXPECT_NEAR(context.at("elastic_stress", static_cast<int>(2 * i + j)), expected, 1e-15) << i << j;
    }
  }
}

TEST(ElasticStress, ForceIsItsDivergence) {
  const PhysicsUnderTest elasticity("elastic_stress", {}, scene_with_a_nematic());
  FakePassContext context(1);
  // d Pi_ab / d x_c at (a 2 + b) 2 + c: f_x = Pi_xx,x + Pi_xy,y
  context.set("elastic_stress_gradient", {1.0, 1e9, 1e9, 10.0, 100.0, 1e9, 1e9, 1000.0});
  context.set("density", {2.0});
  context.set("acceleration", {0.5, 0.25});
  elasticity.run("elastic force", context);
  EXPECT_DOUBLE_EQ(context.at("acceleration", 0), 0.5 + 11.0 / 2.0);
  EXPECT_DOUBLE_EQ(context.at("acceleration", 1), 0.25 + 1100.0 / 2.0);
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
