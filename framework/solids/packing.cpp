#include "solids/packing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "mesogen/exec/dispatch.hpp"
#include "mesogen/exec/first_failure.hpp"
#include "mesogen/neighbours/point_cells.hpp"
#include "mesogen/particles/periodic.hpp"

namespace mesogen {

namespace {

using Point = Shape::Point;

// In spacings.
constexpr double radius = 2.5;        // within which particles push each other
constexpr double moving_band = 16.0;  // from the surface, of the fluid
constexpr double diffusivity = 0.4;   // D, in the square of a spacing for each round
constexpr double longest_move = 0.1;  // in a round
constexpr double enough = 1e-3;       // longest move of the last round
constexpr int most_rounds = 200;

enum class Side : std::uint8_t { fluid, solid };

struct Placed {
  Point at;
  double distance;  // from the surface, when last looked
  Side side;
  bool moves;
};

template <int Dim>
typename PointCells<Dim>::Point of(const Point& at) {
  typename PointCells<Dim>::Point point;
  std::copy_n(at.begin(), Dim, point.begin());
  return point;
}

class Spreading {
 public:
  Spreading(const FluidRegion& region, const Scene& scene, std::vector<Placed>& placed,
            const std::vector<Point>& behind_faces)
      : region_(region), scene_(scene), placed_(placed), behind_faces_(behind_faces) {}

  void run() {
    for (int round = 0; round < most_rounds; ++round) {
      const double longest = dispatch(scene_.dimension, [&]<int Dim>() { return move_all<Dim>(); });
      if (longest < enough * scene_.spacing) break;
    }
  }

 private:
  template <int Dim>
  double move_all() {
    std::vector<typename PointCells<Dim>::Point> points;
    points.reserve(placed_.size() + behind_faces_.size());
    for (const Placed& one : placed_) points.push_back(of<Dim>(one.at));
    for (const Point& at : behind_faces_) points.push_back(of<Dim>(at));
    const double reach = radius * scene_.spacing;
    const PointCells<Dim> cells(scene_, points, reach);
    std::vector<Point> next(placed_.size());
    const auto count = static_cast<Index>(placed_.size());
    double longest = 0.0;
    exec::FirstFailure failure;
#pragma omp parallel for schedule(static) reduction(max : longest)
    for (Index i = 0; i < count; ++i) {
      Placed& one = placed_[static_cast<std::size_t>(i)];
      next[static_cast<std::size_t>(i)] = one.at;
      if (!one.moves) continue;
      try {
        const Point to = kept(one, pushed<Dim>(cells, points[static_cast<std::size_t>(i)], one.at, reach));
        longest = std::max(longest, std::hypot(to[0] - one.at[0], to[1] - one.at[1], to[2] - one.at[2]));
        next[static_cast<std::size_t>(i)] = to;
      } catch (...) {
        failure.keep();
      }
    }
    failure.rethrow();
    for (std::size_t i = 0; i < placed_.size(); ++i) placed_[i].at = wrapped(next[i]);
    return longest;
  }

  // Wendland's C2 kernel with this radius.
  template <int Dim>
  Point pushed(const PointCells<Dim>& cells, const typename PointCells<Dim>::Point& at, Point from,
               double reach) const {
    const double dx = scene_.spacing;
    const double norm =
        Dim == 2 ? 7.0 / (std::numbers::pi * reach * reach) : 21.0 / (2.0 * std::numbers::pi * reach * reach * reach);
    const double scale = diffusivity * dx * dx * std::pow(dx, Dim) * norm * 20.0 / (reach * reach);
    Point by{};
    cells.within(at, reach, [&](Index, const auto& way, double square) {
      const double rest = 1.0 - std::sqrt(square) / reach;
      for (int d = 0; d < Dim; ++d)
        by[static_cast<std::size_t>(d)] -= scale * rest * rest * rest * way[static_cast<std::size_t>(d)];
    });
    const double length = std::hypot(by[0], by[1], by[2]);
    const double share = length > longest_move * dx ? longest_move * dx / length : 1.0;
    for (std::size_t d = 0; d < 3; ++d) from[d] += share * by[d];
    return from;
  }

  /// On its side of the surface, and between the faces of the box.
  Point kept(Placed& one, Point at) const {
    const double half = 0.5 * scene_.spacing;
    if (std::abs(one.distance) < 4.0 * half) {
      at = region_.kept_away(at, one.side == Side::fluid ? half : -half);
      one.distance = region_.distance(at);
    } else {
      one.distance += one.distance > 0.0 ? -longest_move * scene_.spacing : longest_move * scene_.spacing;
    }
    for (int d = 0; d < scene_.dimension; ++d) {
      const auto axis = static_cast<std::size_t>(d);
      if (!scene_.periodic[axis]) at[axis] = std::clamp(at[axis], half, scene_.box[axis] - half);
    }
    return at;
  }

  [[nodiscard]] Point wrapped(Point at) const {
    std::int32_t boxes = 0;
    for (int d = 0; d < scene_.dimension; ++d)
      if (const auto axis = static_cast<std::size_t>(d); scene_.periodic[axis])
        wrap_into_box(scene_.box[axis], at[axis], boxes);
    return at;
  }

  const FluidRegion& region_;
  const Scene& scene_;
  std::vector<Placed>& placed_;
  const std::vector<Point>& behind_faces_;
};

}  // namespace

Packing pack(const FluidRegion& region, const Scene& scene, const Arrangement& lattice,
             const std::vector<Point>& behind_faces, double reach) {
  const double dx = scene.spacing;
  std::vector<Placed> placed;
  for (Index i = 0; i < lattice.count; ++i) {
    Point at{};
    for (int d = 0; d < scene.dimension; ++d)
      at[static_cast<std::size_t>(d)] = lattice.position[static_cast<std::size_t>(d)][static_cast<std::size_t>(i)];
    const double distance = region.distance(at);
    // Those behind what the fluid sees hold the others in place.
    if (distance < -reach - radius * dx) continue;
    const bool moves = distance > -reach && distance < moving_band * dx;
    placed.push_back({at, distance, distance > 0.0 ? Side::fluid : Side::solid, moves});
  }
  Spreading(region, scene, placed, behind_faces).run();
  Packing packing;
  for (const Placed& one : placed)
    if (one.side == Side::fluid) packing.fluid.push_back(one.at);
  dispatch(scene.dimension, [&]<int Dim>() {
    std::vector<typename PointCells<Dim>::Point> points;
    for (const Point& at : packing.fluid) points.push_back(of<Dim>(at));
    const PointCells<Dim> fluid(scene, points, reach);
    for (const Placed& one : placed) {
      if (one.side == Side::fluid) continue;
      bool seen = false;
      fluid.within(of<Dim>(one.at), reach, [&](Index, const auto&, double) { seen = true; });
      if (seen) packing.solid.push_back(one.at);
    }
  });
  return packing;
}

}  // namespace mesogen
