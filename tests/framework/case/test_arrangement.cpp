#include "case/arrangement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace mesogen {
namespace {

Case box(double width, double height, double spacing, const std::string& arrangement) {
  Case source;
  source.domain.size = {width, height};
  source.particles.spacing = spacing;
  source.particles.arrangement = arrangement;
  return source;
}

double nearest_distance(const Case& source, const Arrangement& particles, std::size_t i) {
  double least = 1e300;
  for (std::size_t j = 0; j < particles.position[0].size(); ++j) {
    if (j == i) continue;
    const double dx = std::remainder(particles.position[0][i] - particles.position[0][j], source.domain.size[0]);
    const double dy = std::remainder(particles.position[1][i] - particles.position[1][j], source.domain.size[1]);
    least = std::min(least, std::hypot(dx, dy));
  }
  return least;
}

TEST(Arrangement, LatticeHoldsCellCentresRowByRow) {
  const auto particles = arrange(box(1.0, 0.5, 0.1, "lattice"));
  ASSERT_EQ(particles.count, 50);
  EXPECT_DOUBLE_EQ(particles.position[0][0], 0.05);
  EXPECT_DOUBLE_EQ(particles.position[1][0], 0.05);
  EXPECT_DOUBLE_EQ(particles.position[0][1], 0.15);
  EXPECT_DOUBLE_EQ(particles.position[0][49], 0.95);
  EXPECT_DOUBLE_EQ(particles.position[1][49], 0.45);
}

TEST(Arrangement, LatticeFillsTheBoxWhereTheSpacingIsRounded) {
  const auto source = box(10.0, 10.0, 0.2222, "lattice");
  EXPECT_EQ(arrangement_problem(source), "");
  const auto particles = arrange(source);
  ASSERT_EQ(particles.count, 45 * 45);
  EXPECT_DOUBLE_EQ(particles.position[0][1] - particles.position[0][0], 10.0 / 45.0);
}

TEST(Arrangement, TellsTheSpacingThatFits) {
  EXPECT_EQ(fitted_spacing_text(box(10.0, 5.0, 0.1, "lattice")), "");
  EXPECT_EQ(fitted_spacing_text(box(10.0, 5.0, 0.2222, "jittered")),
            "spacing 0.222222 m along x, 0.217391 m along y, so that whole rows fit the box");
  EXPECT_EQ(fitted_spacing_text(box(10.0, 10.0, 0.25, "hexagonal")),
            "columns 0.263158 m and rows 0.238095 m apart, so that they fit the box");
}

TEST(Arrangement, HexagonalIsPeriodicAndEven) {
  const auto source = box(10.0, 10.0, 0.25, "hexagonal");
  ASSERT_EQ(arrangement_problem(source), "");
  const auto counts = lattice_counts(source);
  EXPECT_EQ(counts.along[1] % 2, 0);
  const auto particles = arrange(source);
  EXPECT_NEAR(particles.count * 0.25 * 0.25 / 100.0, 1.0, 0.02);
  // all particles see the same: also those at the faces
  const double distance = nearest_distance(source, particles, 0);
  for (std::size_t i = 0; i < particles.position[0].size(); i += 7)
    EXPECT_NEAR(nearest_distance(source, particles, i), distance, 1e-12) << i;
  EXPECT_NEAR(distance, 0.25 * std::sqrt(2.0 / std::sqrt(3.0)), 0.02);
}

TEST(Arrangement, JitterIsBoundedSeededAndInTheBox) {
  auto source = box(2.0, 1.0, 0.05, "jittered");
  source.particles.jitter = 0.4;
  const auto lattice = arrange(box(2.0, 1.0, 0.05, "lattice"));
  const auto first = arrange(source);
  EXPECT_EQ(first.position, arrange(source).position);
  source.particles.seed = 2;
  EXPECT_NE(first.position, arrange(source).position);
  double largest = 0.0;
  double mean = 0.0;
  for (std::size_t axis = 0; axis < 2; ++axis)
    for (std::size_t i = 0; i < first.position[axis].size(); ++i) {
      const double shift = first.position[axis][i] - lattice.position[axis][i];
      largest = std::max(largest, std::abs(shift));
      mean += shift / 1600.0;
      EXPECT_GE(first.position[axis][i], 0.0);
      EXPECT_LT(first.position[axis][i], source.domain.size[axis]);
    }
  EXPECT_LE(largest, 0.02);
  EXPECT_GT(largest, 0.0199);
  EXPECT_NEAR(mean, 0.0, 0.001);
}

TEST(Arrangement, LatticeOfThreeDimensionsGoesLayerByLayer) {
  auto source = box(1.0, 0.5, 0.1, "lattice");
  source.domain.size.push_back(0.8);
  ASSERT_EQ(source.dimension(), 3);
  EXPECT_EQ(dimension_problem(source), "");
  EXPECT_EQ(arrangement_problem(source), "");
  const auto particles = arrange(source);
  ASSERT_EQ(particles.count, 10 * 5 * 8);
  const std::size_t id = 2 * 50 + 3 * 10 + 4;
  EXPECT_NEAR(particles.position[0][id], 0.45, 1e-15);
  EXPECT_NEAR(particles.position[1][id], 0.35, 1e-15);
  EXPECT_NEAR(particles.position[2][id], 0.25, 1e-15);
  source.domain.size[2] = 0.83;
  EXPECT_EQ(arrangement_problem(source),
            "does not fit the box: 0.83 m are 8.30 spacings along z; 0.10375 m would make it 8");
}

TEST(Arrangement, HexagonalIsOneOfTwoDimensions) {
  auto source = box(10.0, 10.0, 0.25, "hexagonal");
  EXPECT_EQ(dimension_problem(source), "");
  source.domain.size.push_back(10.0);
  EXPECT_EQ(dimension_problem(source),
            "\"hexagonal\" is an arrangement of 2 dimensions, and domain.size has 3 numbers; take \"lattice\" or "
            "\"jittered\"");
}

TEST(Arrangement, TellsWhereTheSpacingDoesNotFit) {
  EXPECT_EQ(arrangement_problem(box(1.0, 1.03, 0.1, "lattice")),
            "does not fit the box: 1.03 m are 10.30 spacings along y; 0.103 m would make it 10");
  EXPECT_EQ(arrangement_problem(box(1.0, 1.005, 0.1, "lattice")), "");
}

}  // namespace
}  // namespace mesogen
