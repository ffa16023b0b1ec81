// Means of a field at the nodes of a grid, against sums over all particles and all their images.

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <random>

#include "mesogen/mesh/node_means.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::mesh;

Scene scene_of(std::array<double, 3> box, bool periodic_x, bool periodic_y) {
  Scene scene;
  scene.dimension = 2;
  scene.box = box;
  scene.periodic = {periodic_x, periodic_y, false};
  return scene;
}

Nodes nodes_of(const Scene& scene, int columns, int rows) {
  Nodes nodes;
  nodes.count = {columns, rows};
  for (std::size_t d = 0; d < 2; ++d) {
    nodes.spacing[d] = scene.box[d] / nodes.count[d];
    nodes.first[d] = scene.periodic[d] ? 0.0 : 0.5 * nodes.spacing[d];
  }
  return nodes;
}

using Values = std::array<double, 2>;

struct Particles {
  std::array<std::vector<double>, 2> position;
  std::vector<double> field;  // of two components, one behind the other

  [[nodiscard]] std::size_t count() const { return position[0].size(); }
  [[nodiscard]] double value(std::size_t c, std::size_t n) const { return field[c * count() + n]; }
  [[nodiscard]] Carriers carriers() const {
    return {position, {{field.data(), static_cast<std::ptrdiff_t>(count())}, {}}};
  }
};

Particles random_particles(const Scene& scene, int count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Particles particles;
  for (int n = 0; n < count; ++n)
    for (std::size_t d = 0; d < 2; ++d) particles.position[d].push_back(unit(random) * scene.box[d]);
  for (int n = 0; n < 2 * count; ++n) particles.field.push_back(unit(random) - 0.5);
  return particles;
}

sph::SmoothingKernel quintic(double smoothing_length) {
  sph::SmoothingKernel kernel;
  kernel.shape.pieces = {{3.0, {1.0}}, {2.0, {-6.0}}, {1.0, {15.0}}};
  kernel.shape.power = 5;
  kernel.smoothing_length = smoothing_length;
  kernel.scale = 1.0;
  return kernel;
}

double quintic_at(double q) {
  const auto power = [q](double knot) { return std::pow(std::max(knot - q, 0.0), 5); };
  return power(3.0) - 6.0 * power(2.0) + 15.0 * power(1.0);
}

Values by_hand(const Scene& scene, const Particles& particles, double x, double y, double smoothing_length) {
  constexpr int boxes = 4;
  double weights = 0.0;
  Values sum{};
  for (int b = scene.periodic[1] ? -boxes : 0; b <= (scene.periodic[1] ? boxes : 0); ++b) {
    for (int a = scene.periodic[0] ? -boxes : 0; a <= (scene.periodic[0] ? boxes : 0); ++a) {
      for (std::size_t n = 0; n < particles.count(); ++n) {
        const double distance = std::hypot(particles.position[0][n] + a * scene.box[0] - x,
                                           particles.position[1][n] + b * scene.box[1] - y);
        const double weight = quintic_at(distance / smoothing_length);
        weights += weight;
        for (std::size_t c = 0; c < 2; ++c) sum[c] += weight * particles.value(c, n);
      }
    }
  }
  return {sum[0] / weights, sum[1] / weights};
}

void expect_means(const Scene& scene, const Nodes& nodes, const Particles& particles, double smoothing_length) {
  const auto found = node_means(scene, nodes, particles.carriers(), quintic(smoothing_length));
  ASSERT_EQ(found.size(), static_cast<std::size_t>(nodes.count[0] * nodes.count[1]));
  for (int j = 0; j < nodes.count[1]; ++j) {
    for (int i = 0; i < nodes.count[0]; ++i) {
      const Values wanted = by_hand(scene, particles, nodes.first[0] + i * nodes.spacing[0],
                                    nodes.first[1] + j * nodes.spacing[1], smoothing_length);
      const Values& mean = found[static_cast<std::size_t>(j * nodes.count[0] + i)];
      EXPECT_NEAR(mean[0], wanted[0], 1e-12) << i << ' ' << j;
      EXPECT_NEAR(mean[1], wanted[1], 1e-12) << i << ' ' << j;
    }
  }
}

TEST(NodeMeans, AreThoseOfTheParticlesAround) {
  for (const bool periodic_x : {true, false}) {
    for (const bool periodic_y : {true, false}) {
      const Scene scene = scene_of({1.0, 0.7, 0.0}, periodic_x, periodic_y);
      expect_means(scene, nodes_of(scene, 20, 14), random_particles(scene, 600), 0.06);
    }
  }
}

// A kernel that reaches over the box sees several images of a particle.
TEST(NodeMeans, CountEveryImage) {
  for (const bool periodic : {true, false}) {
    const Scene scene = scene_of({1.0, 0.7, 0.0}, periodic, periodic);
    expect_means(scene, nodes_of(scene, 5, 3), random_particles(scene, 10), 0.8);
  }
}

// With one particle there is no node without it, however far.
TEST(NodeMeans, LookFartherWhereNoParticleIsNear) {
  const Scene scene = scene_of({1.0, 0.7, 0.0}, true, false);
  const Particles one = random_particles(scene, 1);
  for (const Values& mean : node_means(scene, nodes_of(scene, 20, 14), one.carriers(), quintic(0.02)))
    for (std::size_t c = 0; c < 2; ++c) EXPECT_NEAR(mean[c], one.value(c, 0), 1e-15);
}

TEST(NodeMeans, AreNotNumbersWithoutParticles) {
  const Scene scene = scene_of({1.0, 0.7, 0.0}, true, true);
  const Particles none;
  for (const Values& mean : node_means(scene, nodes_of(scene, 4, 4), none.carriers(), quintic(0.02)))
    EXPECT_TRUE(std::isnan(mean[0]) && std::isnan(mean[1]));
}

TEST(NodeMeans, HaveTheSameBitsWithAnyNumberOfThreads) {
  const Scene scene = scene_of({1.0, 0.7, 0.0}, true, false);
  const Particles particles = random_particles(scene, 6000);
  const int before = omp_get_max_threads();
  std::vector<std::vector<Values>> all;
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    all.push_back(node_means(scene, nodes_of(scene, 90, 63), particles.carriers(), quintic(0.012)));
  }
  omp_set_num_threads(before);
  EXPECT_EQ(all[1], all[0]);
  EXPECT_EQ(all[2], all[0]);
}

}  // namespace
