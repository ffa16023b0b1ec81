#include "run/initial_extent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "mesogen/exec/dispatch.hpp"
#include "mesogen/neighbours/point_cells.hpp"

namespace mesogen {

namespace {

template <int Dim>
using Point = typename PointCells<Dim>::Point;

template <int Dim>
Point<Dim> point_of(const std::array<double, 3>& position) {
  Point<Dim> point;
  std::copy_n(position.begin(), Dim, point.begin());
  return point;
}

/// The particle nearest to a point.
template <int Dim>
Index nearest(const PointCells<Dim>& particles, const Point<Dim>& point, double radius) {
  for (;; radius *= 2.0) {
    Index found = -1;
    double least = std::numeric_limits<double>::infinity();
    particles.within(point, radius, [&](Index j, const Point<Dim>&, double square) {
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
template <int Dim>
struct Carriers {
  std::vector<Point<Dim>> points;
  std::vector<std::vector<double>> values;  // by component
};

template <int Dim>
Carriers<Dim> with_walls(const FieldDeclaration& field, const Components& components, const InitialState& state,
                         const Boundary& boundary) {
  const Scene& scene = state.scene();
  Carriers<Dim> all;
  for (const auto& values : components) all.values.emplace_back(values.begin(), values.end());
  all.points.resize(components[0].size());
  for (int d = 0; d < Dim; ++d)
    for (std::size_t i = 0; i < all.points.size(); ++i)
      all.points[i][static_cast<std::size_t>(d)] = state.position(d)[i];
  const std::vector<WallParticle> walls = boundary.wall_particles(scene, scene.support);
  if (walls.empty()) return all;
  const FieldKind kind{field.rank, FieldRole::state, scene.dimension};
  const PointCells<Dim> particles(scene, all.points, scene.spacing);
  for (const WallParticle& wall : walls) {
    const auto source = static_cast<std::size_t>(nearest<Dim>(particles, point_of<Dim>(wall.mirror), scene.spacing));
    const AffineRule rule = boundary.wall_rule(scene, kind, wall);
    for (int r = 0; r < kind.components(); ++r) {
      double value = rule.summand(r);
      for (int c = 0; c < kind.components(); ++c)
        value += rule.matrix(r, c) * components[static_cast<std::size_t>(c)][source];
      all.values[static_cast<std::size_t>(r)].push_back(value);
    }
    all.points.push_back(point_of<Dim>(wall.position));
  }
  return all;
}

double length(const std::vector<double>& components) {
  if (components.size() == 2) return std::hypot(components[0], components[1]);
  double square = 0.0;
  for (const double component : components) square += component * component;
  return std::sqrt(square);
}

template <int Dim>
double largest_laplacian(const Carriers<Dim>& all, std::size_t count, const Scene& scene,
                         const sph::SmoothingKernel& kernel) {
  const PointCells<Dim> cells(scene, all.points, scene.support);
  const double volume = scene.fluid_volume / static_cast<double>(count);
  std::vector<double> laplacian(count);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<double> sum(all.values.size(), 0.0);
    cells.within(all.points[i], kernel.radius(), [&](Index j, const Point<Dim>&, double square) {
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
    extent.laplacian = dispatch(state.scene().dimension, [&]<int Dim>() {
      return largest_laplacian<Dim>(with_walls<Dim>(field, components, state, boundary), count, state.scene(), kernel);
    });
  return extent;
}

}  // namespace mesogen
