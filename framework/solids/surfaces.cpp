#include "solids/surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesogen/exec/first_failure.hpp"
#include "solids/clear_cells.hpp"

namespace mesogen {

namespace {

using Point = Shape::Point;

constexpr int fineness = 3;  // points of the quadrature in a spacing

/// A regular grid over the box, or over one of its faces: cell centres, counted along each axis.
struct Quadrature {
  std::array<int, 3> count{1, 1, 1};
  Point width{};

  Quadrature(const Scene& scene, int without_axis) {
    for (int d = 0; d < scene.dimension; ++d) {
      if (d == without_axis) continue;
      const auto axis = static_cast<std::size_t>(d);
      count[axis] = std::max(1, static_cast<int>(std::lround(fineness * scene.box[axis] / scene.spacing)));
      width[axis] = scene.box[axis] / count[axis];
    }
  }
  [[nodiscard]] int total() const { return count[0] * count[1] * count[2]; }
  [[nodiscard]] Point at(int n) const {
    return {(n % count[0] + 0.5) * width[0], (n / count[0] % count[1] + 0.5) * width[1],
            (n / count[0] / count[1] + 0.5) * width[2]};
  }
  /// Volume of a cell, or area of a part of the face, over that of its axes.
  [[nodiscard]] double cell(int dimension, int without_axis) const {
    double product = 1.0;
    for (int d = 0; d < dimension; ++d)
      if (d != without_axis) product *= width[static_cast<std::size_t>(d)];
    return product;
  }
};

WallSurface face(const Scene& scene, int axis, bool high, const FluidRegion* region) {
  const auto across = static_cast<std::size_t>(axis);
  WallSurface surface;
  surface.name = std::string(1, "xyz"[across]) + (high ? "_high" : "_low");
  for (std::size_t d = 0; d < static_cast<std::size_t>(scene.dimension); ++d) surface.centre[d] = 0.5 * scene.box[d];
  const Quadrature points(scene, axis);
  for (int n = 0; n < points.total(); ++n) {
    SurfaceElement element{points.at(n), {}, points.cell(scene.dimension, axis)};
    element.point[across] = high ? scene.box[across] : 0.0;
    element.normal[across] = high ? -1.0 : 1.0;
    if (region == nullptr || region->distance(element.point) > 0.0) surface.elements.push_back(element);
  }
  return surface;
}

/// Does the velocity change sign behind the face, about that of the wall?
bool face_sticks(const Scene& scene, const Boundary& boundary, int axis, bool high) {
  const auto across = static_cast<std::size_t>(axis);
  for (const WallParticle& wall : boundary.wall_particles(scene, scene.support)) {
    if (!(high ? wall.normal[across] < -0.9 : wall.normal[across] > 0.9)) continue;
    const AffineRule rule = boundary.wall_rule(scene, {Rank::vector, FieldRole::velocity, scene.dimension}, wall);
    for (int c = 0; c < rule.components(); ++c)
      if (rule.matrix(c, c) != -1.0) return false;
    return true;
  }
  return false;
}

/// Of each cell near a surface the part that a smoothed delta function of the distance gives to it: what level sets on
/// one side have too much those on the other lack (J. Smereka, J. Comput. Phys. 211, 77 (2006)).
void add_solids(const Scene& scene, const FluidRegion& region, std::vector<WallSurface>& surfaces) {
  const std::size_t first = surfaces.size();
  for (const Solid& solid : region.solids()) surfaces.push_back({solid.name(), solid.centre(), solid.sticks(), {}});
  const Quadrature points(scene, -1);
  const ClearCells clear(region, scene);
  const double width = 1.5 * scene.spacing / fineness;
  std::vector<std::vector<std::pair<std::size_t, SurfaceElement>>> found(static_cast<std::size_t>(points.count[1]));
  exec::FirstFailure failure;
#pragma omp parallel for schedule(dynamic)
  for (int row = 0; row < points.count[1]; ++row) {
    try {
      for (int layer = 0; layer < points.count[2]; ++layer)
        for (int column = 0; column < points.count[0]; ++column) {
          const Point at = points.at((layer * points.count[1] + row) * points.count[0] + column);
          if (clear.hold(at.data())) continue;
          const FluidRegion::Nearest nearest = region.nearest(at);
          if (std::abs(nearest.distance) >= width) continue;
          const Solid& solid = region.solid(nearest.solid);
          SurfaceElement element{solid.nearest(at), solid.normal(at), points.cell(scene.dimension, -1)};
          element.area *= (1.0 + std::cos(std::numbers::pi * nearest.distance / width)) / (2.0 * width);
          if (region.distance(element.point) < -1e-3 * scene.spacing) continue;
          found[static_cast<std::size_t>(row)].emplace_back(nearest.solid, element);
        }
    } catch (...) {
      failure.keep();
    }
  }
  failure.rethrow();
  for (const auto& row : found)
    for (const auto& [solid, element] : row) surfaces[first + solid].elements.push_back(element);
}

}  // namespace

std::vector<WallSurface> wall_surfaces(const Scene& scene, const Boundary& boundary, const FluidRegion* region) {
  std::vector<WallSurface> surfaces;
  for (int axis = 0; axis < scene.dimension; ++axis)
    if (!scene.periodic[static_cast<std::size_t>(axis)])
      for (const bool high : {false, true}) {
        surfaces.push_back(face(scene, axis, high, region));
        surfaces.back().sticks = face_sticks(scene, boundary, axis, high);
      }
  if (region != nullptr) add_solids(scene, *region, surfaces);
  return surfaces;
}

}  // namespace mesogen
