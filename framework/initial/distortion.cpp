#include "initial/distortion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesogen/domain/point_cells.hpp"

namespace mesogen {

namespace {

using Point = std::array<double, 2>;

Point point_of(const std::array<double, 3>& position) { return {position[0], position[1]}; }

/// The particle nearest to a point.
Index nearest(const PointCells<2>& particles, const Point& point, double radius) {
  for (;; radius *= 2.0) {
    Index found = -1;
    double least = std::numeric_limits<double>::infinity();
    particles.within(point, radius, [&](Index j, const Point&, double square) {
      if (square < least) {
        least = square;
        found = j;
      }
    });
    if (found >= 0) return found;
  }
}

/// Points that carry an order tensor: particles, then what lies behind the walls.
struct Carriers {
  std::vector<Point> points;
  std::array<std::vector<double>, 2> tensor;
};

Carriers with_walls(const std::array<std::vector<double>, 2>& tensor,
                    const std::array<std::vector<double>, 3>& position, const Scene& scene, const Boundary& boundary) {
  Carriers all{{}, tensor};
  for (std::size_t i = 0; i < position[0].size(); ++i) all.points.push_back({position[0][i], position[1][i]});
  const std::vector<WallParticle> walls = boundary.wall_particles(scene, scene.support);
  if (walls.empty()) return all;
  const FieldKind field{Rank::order_tensor, FieldRole::state, scene.dimension};
  const PointCells<2> particles(scene, all.points, scene.spacing);
  for (const WallParticle& wall : walls) {
    const auto source = static_cast<std::size_t>(nearest(particles, point_of(wall.mirror), scene.spacing));
    const AffineRule rule = boundary.wall_rule(scene, field, wall);
    for (int c = 0; c < 2; ++c)
      all.tensor[static_cast<std::size_t>(c)].push_back(rule.matrix(c, 0) * tensor[0][source] +
                                                        rule.matrix(c, 1) * tensor[1][source] + rule.summand(c));
    all.points.push_back(point_of(wall.position));
  }
  return all;
}

}  // namespace

Distortion distortion_of(const std::array<std::vector<double>, 2>& tensor,
                         const std::array<std::vector<double>, 3>& position, const Scene& scene,
                         const Boundary& boundary, const sph::SmoothingKernel& kernel) {
  Distortion distortion;
  const std::size_t count = tensor[0].size();
  if (count == 0) return distortion;
  const Carriers all = with_walls(tensor, position, scene, boundary);
  const PointCells<2> cells(scene, all.points, scene.support);
  const double volume = scene.box[0] * scene.box[1] / static_cast<double>(count);
  std::vector<double> laplacian(count);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) {
    std::array<double, 2> sum{};
    cells.within(all.points[i], kernel.radius(), [&](Index j, const Point&, double square) {
      if (!(square > 0.0)) return;
      const double r = std::sqrt(square);
      const double slope =
          kernel.scale * kernel.shape.derivative(r / kernel.smoothing_length) / kernel.smoothing_length;
      for (std::size_t c = 0; c < 2; ++c)
        sum[c] += 2.0 * volume * slope / r * (all.tensor[c][i] - all.tensor[c][static_cast<std::size_t>(j)]);
    });
    laplacian[i] = std::hypot(sum[0], sum[1]);
  }
  distortion.laplacian = *std::max_element(laplacian.begin(), laplacian.end());
  distortion.lowest_order = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    const double order = std::hypot(tensor[0][i], tensor[1][i]);
    distortion.lowest_order = std::min(distortion.lowest_order, order);
    distortion.highest_order = std::max(distortion.highest_order, order);
  }
  return distortion;
}

}  // namespace mesogen
