// Gradient, Laplacian, correction and volume as the framework offers them to all plugins.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "particle_scene.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

constexpr double two_pi = 2.0 * std::numbers::pi;

double largest_difference(const std::vector<double>& values, double expected) {
  double most = 0.0;
  for (const double x : values) most = std::max(most, std::abs(x - expected));
  return most;
}

/// Each test with all kernels, all with a support of 4 spacings.
class Operators : public testing::TestWithParam<const char*> {
 protected:
  [[nodiscard]] ParticleScene::Options options(int across, Precision precision = Precision::double_precision) const {
    ParticleScene::Options options;
    options.spacing = 1.0 / across;
    options.kernel = GetParam();
    options.smoothing_length = options.kernel == "quintic" ? 4.0 / 3.0 : 2.0;
    options.precision = precision;
    return options;
  }

  /// Root of the mean square error of the Laplacian of a wave, relative to its size.
  [[nodiscard]] double error_of_laplacian(int across, double jitter = 0.0, bool consistent = false) const {
    ParticleScene::Options chosen = options(across);
    chosen.consistent_laplacian = consistent;
    const auto points = jittered(across, across, 1.0 / across, jitter);
    ParticleScene scene(chosen, points);
    const auto wave = [](double x, double y) { return std::sin(two_pi * (x + y)); };
    scene.set(wave);
    const auto laplacian = scene.derived("f_laplacian");
    double sum = 0.0;
    for (std::size_t i = 0; i < laplacian.size(); ++i)
      sum += std::pow(laplacian[i] / (two_pi * two_pi) + 2.0 * wave(points[0][i], points[1][i]), 2);
    return std::sqrt(sum / (across * across) / 2.0);
  }
};

TEST_P(Operators, VolumesOfALatticeAreThoseOfItsCells) {
  ParticleScene scene(options(20), lattice(20, 20, 0.05));
  const auto volume = scene.derived("volume");
  // The kernel's sum over a lattice differs from its integral by the kernel's smoothness.
  for (const double v : volume) {
    ASSERT_NEAR(v / 0.0025, 1.0, 5e-3);
    ASSERT_NEAR(v, volume.front(), 1e-15);
  }
}

// f = 3 x - 2 y is not periodic: where no neighbour lies across a face, its gradient is exact on any particles.
TEST_P(Operators, GradientOfALinearFieldIsExactOnJitteredParticles) {
  constexpr int across = 23;  // 529 particles: no multiple of those that are solved for together
  for (const auto& [precision, tolerance] :
       {std::pair{Precision::double_precision, 1e-12}, std::pair{Precision::single_precision, 2e-4}}) {
    const auto points = jittered(across, across, 1.0 / across, 0.2);
    ParticleScene scene(options(across, precision), points);
    scene.set([](double x, double y) { return 3.0 * x - 2.0 * y; });
    const auto along_x = scene.derived("f_gradient", 0);
    const auto along_y = scene.derived("f_gradient", 1);
    int compared = 0;
    for (std::size_t i = 0; i < points[0].size(); ++i) {
      const double to_face = std::min({points[0][i], 1.0 - points[0][i], points[1][i], 1.0 - points[1][i]});
      if (to_face < 4.2 / across) continue;
      ASSERT_NEAR(along_x[i], 3.0, tolerance);
      ASSERT_NEAR(along_y[i], -2.0, tolerance);
      ++compared;
    }
    EXPECT_GT(compared, 150);
  }
}

TEST_P(Operators, CorrectionOfALatticeIsAMultipleOfUnity) {
  ParticleScene scene(options(16), lattice(16, 16, 1.0 / 16));
  const auto diagonal = scene.derived("correction", 0);
  EXPECT_NEAR(diagonal[0], 1.0, 0.003);
  EXPECT_LT(largest_difference(diagonal, diagonal[0]), 1e-12);
  EXPECT_LT(largest_difference(scene.derived("correction", 3), diagonal[0]), 1e-12);
  EXPECT_LT(largest_difference(scene.derived("correction", 1), 0.0), 1e-12);
  EXPECT_LT(largest_difference(scene.derived("correction", 2), 0.0), 1e-12);
}

TEST_P(Operators, LaplacianConvergesInSecondOrderOnALattice) {
  const double coarse = error_of_laplacian(24);
  const double fine = error_of_laplacian(48);
  EXPECT_LT(fine, 0.012);
  EXPECT_GT(std::log2(coarse / fine), 1.8) << coarse << ", " << fine;
}

// On disordered particles the plain Laplacian does not converge; the consistent one is exact for quadratic functions.
TEST_P(Operators, ConsistentLaplacianOfAQuadraticIsExactOnJitteredParticles) {
  constexpr int across = 23;  // 529 particles: no multiple of those that are solved for together
  for (const auto& [precision, tolerance] :
       {std::pair{Precision::double_precision, 1e-9}, std::pair{Precision::single_precision, 5e-3}}) {
    const auto points = jittered(across, across, 1.0 / across, 0.2);
    ParticleScene::Options disordered = options(across, precision);
    disordered.consistent_laplacian = true;
    ParticleScene scene(disordered, points);
    scene.set([](double x, double y) { return 1.5 * x * x - 2.0 * x * y + 0.25 * y * y + 3.0 * x - y; });
    const auto laplacian = scene.derived("f_laplacian");
    int compared = 0;
    for (std::size_t i = 0; i < points[0].size(); ++i) {
      const double to_face = std::min({points[0][i], 1.0 - points[0][i], points[1][i], 1.0 - points[1][i]});
      if (to_face < 4.2 / across) continue;
      ASSERT_NEAR(laplacian[i], 3.5, tolerance);
      ++compared;
    }
    EXPECT_GT(compared, 150);
  }
}

// With so many neighbours a particle that not all of them are kept between the two visits.
TEST_P(Operators, DerivativesAreExactWithAWideKernelToo) {
  constexpr int across = 29;
  const auto points = jittered(across, across, 1.0 / across, 0.2);
  ParticleScene::Options wide = options(across);
  wide.smoothing_length *= 3.0;
  wide.consistent_laplacian = true;
  ParticleScene scene(wide, points);
  scene.set([](double x, double y) { return x * x + 3.0 * x * y + 3.0 * x - y; });
  const auto laplacian = scene.derived("f_laplacian");
  scene.set([](double x, double y) { return 3.0 * x - y; });
  const auto along_x = scene.derived("f_gradient", 0);
  const auto along_y = scene.derived("f_gradient", 1);
  int compared = 0;
  for (std::size_t i = 0; i < points[0].size(); ++i) {
    const double to_face = std::min({points[0][i], 1.0 - points[0][i], points[1][i], 1.0 - points[1][i]});
    if (to_face < 12.2 / across) continue;
    ASSERT_NEAR(laplacian[i], 2.0, 1e-9);
    ASSERT_NEAR(along_x[i], 3.0, 1e-10);
    ASSERT_NEAR(along_y[i], -1.0, 1e-10);
    ++compared;
  }
  EXPECT_GT(compared, 15);
}

TEST_P(Operators, ConsistentLaplacianConvergesOnJitteredParticles) {
  const double coarse = error_of_laplacian(24, 0.2, true);
  const double fine = error_of_laplacian(48, 0.2, true);
  EXPECT_LT(fine, 0.03);
  EXPECT_GT(std::log2(coarse / fine), 1.0) << coarse << ", " << fine;
  EXPECT_GT(error_of_laplacian(48, 0.2, false), 5.0 * fine) << "the plain one";
}

TEST_P(Operators, ConsistentLaplacianConvergesInSecondOrderOnALattice) {
  const double coarse = error_of_laplacian(24, 0.0, true);
  const double fine = error_of_laplacian(48, 0.0, true);
  EXPECT_GT(std::log2(coarse / fine), 1.8) << coarse << ", " << fine;
}

TEST_P(Operators, DerivativesOfAConstantVanish) {
  ParticleScene scene(options(16), jittered(16, 16, 1.0 / 16, 0.3));
  scene.set([](double, double) { return 7.0; });
  EXPECT_EQ(largest_difference(scene.derived("f_gradient", 0), 0.0), 0.0);
  EXPECT_EQ(largest_difference(scene.derived("f_gradient", 1), 0.0), 0.0);
  EXPECT_EQ(largest_difference(scene.derived("f_laplacian"), 0.0), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Kernels, Operators, testing::Values("quintic", "wendland_c2", "wendland_c4", "wendland_c6"),
                         [](const auto& set) { return std::string(set.param); });

/// 8 sum_j V_j x^2 y^2 (-W') / r^3 on a lattice: it decides whether the radial viscosity is consistent, for which it
/// must be 2.
double fourth_moment(const char* kernel_name) {
  constexpr double spacing = 0.05;
  ParticleScene::Options options;
  options.spacing = spacing;
  options.kernel = kernel_name;
  ParticleScene scene(options, lattice(20, 20, spacing));
  const sph::SmoothingKernel& kernel = scene.state().kernel;
  const double h = kernel.smoothing_length;
  double moment = 0.0;
  for (int j = -5; j <= 5; ++j) {
    for (int i = -5; i <= 5; ++i) {
      const double r = std::hypot(i, j) * spacing;
      if (r == 0.0 || r >= kernel.radius()) continue;
      const double x = i * spacing;
      const double y = j * spacing;
      moment -= x * x * y * y * kernel.scale / h * kernel.shape.derivative(r / h) / (r * r * r);
    }
  }
  return 8.0 * moment * scene.derived("volume").front();
}

TEST(KernelMoments, FourthMomentOnALatticeFallsShortOfTwo) {
  EXPECT_NEAR(fourth_moment("quintic"), 1.893, 0.0005);
  EXPECT_NEAR(fourth_moment("wendland_c2"), 1.636, 0.0005);
}

}  // namespace
