#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "mesogen/export.hpp"
#include "mesogen/plugin/scene.hpp"
#include "solids/solid.hpp"

namespace mesogen {

/// Where the fluid is: outside of all solids of a case.
class MESOGEN_EXPORT FluidRegion {
 public:
  using Point = Shape::Point;

  /// The solids must outlive it; there is at least one.
  FluidRegion(const std::vector<Solid>& solids, const Scene& scene) : solids_(solids), scene_(scene) {}

  struct Nearest {
    double distance;    ///< m: above 0 in the fluid, below 0 in a solid
    std::size_t solid;  ///< the one whose surface is nearest, or in which the point lies deepest
  };
  [[nodiscard]] Nearest nearest(const Point& at) const;
  [[nodiscard]] double distance(const Point& at) const { return nearest(at).distance; }
  [[nodiscard]] const Solid& solid(std::size_t n) const { return solids_[n]; }
  [[nodiscard]] const std::vector<Solid>& solids() const { return solids_; }

  /// A point of the surface of the fluid.
  struct Foot {
    Point point;
    Point normal;       ///< into the fluid
    std::size_t solid;  ///< whose surface it is
  };
  /// The point of the fluid's surface that is nearest to a point in a solid. Where solids overlap, or meet at an edge,
  /// it is on the surface of all that hide another. Nothing if there is none: the solids do not fit together there.
  [[nodiscard]] std::optional<Foot> foot(const Point& at) const;

  /// Of the surface at one of its points, 1/m: see WallParticle. Zero at edges.
  [[nodiscard]] double curvature(const Foot& at) const;

  /// The point, moved along the surface's normal until it is at least `least` (m) from it: in the fluid, or with
  /// `least` below 0 in the solid.
  [[nodiscard]] Point kept_away(Point at, double least) const;

 private:
  const std::vector<Solid>& solids_;
  const Scene& scene_;
};

}  // namespace mesogen
