#pragma once

#include <array>
#include <cmath>

#include "mesogen/plugin/boundary.hpp"

namespace mesogen {

/// The way from a wall particle to its mirror point, m. Both lie in the box, so across a periodic face it is that to
/// another image of the mirror point: the nearest one on the side to which the normal points.
inline std::array<double, 3> way_to_mirror(const Scene& scene, const Boundary& boundary, const WallParticle& wall) {
  std::array<double, 3> way{};
  for (int axis = 0; axis < scene.dimension; ++axis) {
    const auto d = static_cast<std::size_t>(axis);
    way[d] = wall.mirror[d] - wall.position[d];
    if (!boundary.periodic(axis)) continue;
    way[d] = std::remainder(way[d], scene.box[d]);
    // Along the surface both are rounding.
    if (way[d] * wall.normal[d] < 0.0 && std::abs(way[d]) > 1e-6 * scene.spacing)
      way[d] += std::copysign(scene.box[d], wall.normal[d]);
  }
  return way;
}

}  // namespace mesogen
