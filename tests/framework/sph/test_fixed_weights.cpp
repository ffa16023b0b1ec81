// Where particles keep still, derivatives are sums with weights that are found once: the same numbers.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "particle_scene.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

double wave(double x, double y) { return std::sin(2.0 * std::numbers::pi * (2.0 * x - y)) + 3.0; }

/// The largest difference over the largest value.
double difference(const std::vector<double>& values, const std::vector<double>& others) {
  double most = 0.0;
  double scale = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    most = std::max(most, std::abs(values[i] - others[i]));
    scale = std::max(scale, std::abs(values[i]));
  }
  return most / scale;
}

double difference(ParticleScene& a, ParticleScene& b, const char* field, int component) {
  return difference(a.derived(field, component), b.derived(field, component));
}

/// Boundary, precision, consistent Laplacian.
class FixedWeights : public testing::TestWithParam<std::tuple<const char*, Precision, bool>> {
 protected:
  static constexpr int across = 24;

  [[nodiscard]] static ParticleScene::Options options() {
    ParticleScene::Options options;
    options.spacing = 1.0 / across;
    options.boundary = std::get<0>(GetParam());
    options.precision = std::get<1>(GetParam());
    options.consistent_laplacian = std::get<2>(GetParam());
    return options;
  }
  [[nodiscard]] static double rounding() {
    return std::get<1>(GetParam()) == Precision::double_precision ? 1e-11 : 1e-3;
  }

  void expect_same(ParticleScene& a, ParticleScene& b) const {
    EXPECT_LT(difference(a, b, "f_laplacian", 0), rounding());
    EXPECT_LT(difference(a, b, "f_gradient", 0), rounding());
    EXPECT_LT(difference(a, b, "f_gradient", 1), rounding());
    EXPECT_LT(difference(a, b, "correction", 1), rounding());
  }
};

TEST_P(FixedWeights, GiveTheDerivativesOfThePairSums) {
  auto of_scene = options();
  const auto points = jittered(across, across, 1.0 / across, 0.2);
  ParticleScene computed(of_scene, points);
  of_scene.still = true;
  ParticleScene weighted(of_scene, points);
  for (ParticleScene* scene : {&computed, &weighted}) scene->set(wave);
  expect_same(computed, weighted);
  const auto first = weighted.derived("f_laplacian");

  // Another field at the same places, then the first at others.
  for (ParticleScene* scene : {&computed, &weighted}) scene->set([](double x, double) { return std::cos(4.0 * x); });
  expect_same(computed, weighted);
  EXPECT_NE(weighted.derived("f_laplacian"), first);
  EXPECT_EQ(weighted.weights_found(), 1);
  const auto by = [](std::int64_t id) { return std::array{id % 3 == 0 ? 0.2 / across : 0.0, 0.1 / across}; };
  for (ParticleScene* scene : {&computed, &weighted}) {
    scene->move(by);
    scene->set(wave);
  }
  expect_same(computed, weighted);
  EXPECT_EQ(weighted.weights_found(), 2);
}

// One pass over pairs before the stages finds their weights beside gradients: those of a vector, or of four numbers.
TEST_P(FixedWeights, AreFoundBesideGradients) {
  for (const Rank rank : {Rank::scalar, Rank::vector, Rank::matrix}) {
    auto of_scene = options();
    of_scene.rank = rank;
    const auto points = jittered(across, across, 1.0 / across, 0.2);
    ParticleScene computed(of_scene, points);
    of_scene.stages = true;
    ParticleScene beside(of_scene, points);
    ParticleScene alone(of_scene, points);
    for (ParticleScene* scene : {&computed, &beside, &alone}) scene->set(wave);
    const int last = computed.state().fields.at("f").components() - 1;
    const auto expected = computed.derived("f_laplacian", last);
    EXPECT_LT(difference(beside.laplacian_by_stages("f_gradient", last), expected), rounding());
    EXPECT_LT(difference(alone.laplacian_by_stages("", last), expected), rounding());
    EXPECT_EQ(beside.weights_found(), rank == Rank::scalar ? 1 : 0);  // in a pass of their own
    EXPECT_EQ(alone.weights_found(), 1);
    for (const int n : {0, 1, 2 * last, 2 * last + 1})
      EXPECT_LT(difference(computed, beside, "f_gradient", n), rounding());
    EXPECT_LT(difference(computed, beside, "correction", 3), rounding());
  }
}

// Where particles stay, gradients take the correction that is known: twice of it gives twice of them.
TEST_P(FixedWeights, GradientsOfAnotherFieldTakeTheKnownCorrection) {
  for (const Rank rank : {Rank::scalar, Rank::vector}) {
    auto of_scene = options();
    of_scene.stages = true;
    of_scene.rank = rank;
    const auto points = jittered(across, across, 1.0 / across, 0.2);
    ParticleScene fresh(of_scene, points);
    ParticleScene again(of_scene, points);
    again.set(wave);
    (void)again.derived("f_gradient");
    Field& correction = again.state().fields.at("correction");
    for (Index i = 0; i < again.state().particles.count(); ++i)
      for (int c = 0; c < correction.components(); ++c) correction.set(c, i, 2.0 * correction.value(c, i));
    for (ParticleScene* scene : {&fresh, &again}) scene->set([](double x, double y) { return std::cos(4.0 * x) - y; });
    const int last = 2 * fresh.state().fields.at("f").components() - 1;
    for (const int n : {0, 1, last}) {
      auto expected = fresh.derived("f_gradient", n);
      for (double& number : expected) number *= 2.0;
      EXPECT_LT(difference(again.derived("f_gradient", n), expected), rounding());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, FixedWeights,
                         testing::Combine(testing::Values("periodic_ghosts", "periodic_wrap"),
                                          testing::Values(Precision::single_precision, Precision::double_precision),
                                          testing::Bool()),
                         [](const auto& set) {
                           return std::string(std::get<0>(set.param)) +
                                  (std::get<1>(set.param) == Precision::single_precision ? "_single" : "_double") +
                                  (std::get<2>(set.param) ? "_consistent" : "_plain");
                         });

// A box so small that a particle sees some neighbours on both sides.
TEST(FixedWeightsOfASmallBox, CountBothImages) {
  for (const char* boundary : {"periodic_ghosts", "periodic_wrap"}) {
    ParticleScene::Options options;
    options.spacing = 1.0 / 8;
    options.boundary = boundary;
    const auto points = jittered(8, 8, 1.0 / 8, 0.1);
    ParticleScene computed(options, points);
    options.still = true;
    ParticleScene weighted(options, points);
    for (ParticleScene* scene : {&computed, &weighted}) scene->set(wave);
    const auto expected = computed.derived("f_laplacian");
    const auto found = weighted.derived("f_laplacian");
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-10);
  }
}

}  // namespace
