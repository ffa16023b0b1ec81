// Gradient and Laplacian on unevenly spread particles converge. docs/accuracy/operators.md has the figures.

#include <gtest/gtest.h>

#include "operator_errors.hpp"
#include "particle_scene.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

struct Orders {
  double gradient;
  double laplacian;
};

/// Fitted over the given numbers of waves on the same particles.
Orders orders_on(const Points& points, int across, const std::vector<int>& waves, const OperatorChoice& choice) {
  std::vector<double> resolution;
  std::vector<double> gradient;
  std::vector<double> laplacian;
  for (const int count : waves) {
    const OperatorErrors errors = operator_errors(points, count, choice);
    resolution.push_back(static_cast<double>(across) / count);
    gradient.push_back(errors.gradient);
    laplacian.push_back(errors.laplacian);
  }
  return {fitted_order(resolution, gradient), fitted_order(resolution, laplacian)};
}

void expect_convergence(const Points& points, int across, const std::vector<int>& waves) {
  for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
    const Orders orders = orders_on(points, across, waves, {true, precision});
    EXPECT_GT(orders.gradient, 1.5);
    EXPECT_GT(orders.laplacian, 1.5);
  }
}

TEST(DisorderedOperators, OrderIsFittedAsTheSlopeOfLogarithms) {
  EXPECT_NEAR(fitted_order({10.0, 20.0, 40.0}, {0.16, 0.04, 0.01}), 2.0, 1e-12);
  EXPECT_NEAR(fitted_order({10.0, 30.0}, {0.1, 0.3}), -1.0, 1e-12);
}

TEST(DisorderedOperators, ConvergeOnJitteredParticles) {
  expect_convergence(jittered(64, 64, 1.0 / 64, 0.2), 64, {4, 2, 1});
}

TEST(DisorderedOperators, ConvergeAfterSomeTurbulence) {
  expect_convergence(points_after_turbulence(32, 2000), 32, {3, 2, 1});
}

TEST(DisorderedOperatorsLong, ConvergeAfterTurbulence) {
  expect_convergence(points_after_turbulence(96, 10000), 96, {8, 4, 2, 1});
}

// Its error is the disorder's share of the first derivative over the spacing: it grows as particles come closer.
TEST(DisorderedOperators, PlainLaplacianDivergesOnJitteredParticles) {
  EXPECT_LT(orders_on(jittered(64, 64, 1.0 / 64, 0.2), 64, {2, 1}, {}).laplacian, -0.7);
}

}  // namespace
