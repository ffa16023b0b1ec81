#include "run/initial_extent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "mesogen/neighbours/point_cells.hpp"

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

using Components = std::vector<std::span<const double>>;

/// Points that carry a field: particles, then what lies behind the walls.
struct Carriers {
  std::vector<Point> points;
  std::vector<std::vector<double>> values;  // by component
};

Carriers with_walls(const FieldDeclaration& field, const Components& components, const InitialState& state,
                    const Boundary& boundary) {
  const Scene& scene = state.scene();
  Carriers all;
  for (const auto& values : components) all.values.emplace_back(values.begin(), values.end());
  for (std::size_t i = 0; i < components[0].size(); ++i)
    all.points.push_back({state.position(0)[i], state.position(1)[i]});
  const std::vector<WallParticle> walls = boundary.wall_particles(scene, scene.support);
  if (walls.empty()) return all;
  const FieldKind kind{field.rank, FieldRole::state, scene.dimension};
  const PointCells<2> particles(scene, all.points, scene.spacing);
  for (const WallParticle& wall : walls) {
    const auto source = static_cast<std::size_t>(nearest(particles, point_of(wall.mirror), scene.spacing));
    const AffineRule rule = boundary.wall_rule(scene, kind, wall);
    for (int r = 0; r < kind.components(); ++r) {
      double value = rule.summand(r);
      for (int c = 0; c < kind.components(); ++c)
        value += rule.matrix(r, c) * components[static_cast<std::size_t>(c)][source];
      all.values[static_cast<std::size_t>(r)].push_back(value);
    }
    all.points.push_back(point_of(wall.position));
  }
  return all;
}

double length(const std::vector<double>& components) {
  if (components.size() == 2) return std::hypot(components[0], components[1]);
  double square = 0.0;
  for (const double component : components) square += component * component;
  return std::sqrt(square);
}

double largest_laplacian(const Carriers& all, std::size_t count, const Scene& scene,
                         const sph::SmoothingKernel& kernel) {
  const PointCells<2> cells(scene, all.points, scene.support);
  const double volume = scene.box[0] * scene.box[1] / static_cast<double>(count);
  std::vector<double> laplacian(count);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<double> sum(all.values.size(), 0.0);
    cells.within(all.points[i], kernel.radius(), [&](Index j, const Point&, double square) {
      if (!(square > 0.0)) return;
      const double r = std::sqrt(square);
      const double slope =
          kernel.scale * kernel.shape.derivative(r / kernel.smoothing_length) / kernel.smoothing_length;
      for (std::size_t c = 0; c < sum.size(); ++c)
        sum[c] += 2.0 * volume * slope / r * (all.values[c][i] - all.values[c][static_cast<std::size_t>(j)]);
    });
    laplacian[i] = length(sum);
  }
  return *std::max_element(laplacian.begin(), laplacian.end());
}

}  // namespace

InitialExtent initial_extent(const FieldDeclaration& field, InitialState& state, const Boundary& boundary,
                             const sph::SmoothingKernel& kernel) {
  InitialExtent extent;
  const auto count = static_cast<std::size_t>(state.count());
  if (count == 0) return extent;
  Components components;
  for (int c = 0; c < component_count(field.rank, state.scene().dimension); ++c)
    components.push_back(state.component(field.name, c));
  std::vector<double> value(components.size());
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t c = 0; c < value.size(); ++c) value[c] = components[c][i];
    extent.largest = std::max(extent.largest, length(value));
  }
  if (field.rank == Rank::order_tensor)
    extent.laplacian = largest_laplacian(with_walls(field, components, state, boundary), count, state.scene(), kernel);
  return extent;
}

}  // namespace mesogen
