#include "initial/distortion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

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

// Dummies that stand next to a wall are a spacing away from their mirror points.
constexpr double next_to_wall = 1.5;

/// How far the director that walls hold is from the one that the fluid starts with.
class WallJump {
 public:
  /// A dummy next to a wall: how it goes on from `inside`, component by component.
  void add(const Extension* extension, const Point& inside) {
    Point held{};
    for (std::size_t c = 0; c < 2; ++c) {
      if (extension[c].factor == 1.0) return;  // free
      held[c] = extension[c].summand / (1.0 - extension[c].factor);
    }
    if (std::hypot(held[0], held[1]) < 1e-6) return;  // no order, and so no director
    largest_ = std::max(largest_, between(held, inside));
    if (!first_) first_ = held;
    several_ = several_ || between(*first_, held) > 1e-6;
  }
  void tell(Distortion& distortion) const {
    distortion.wall_jump = largest_;
    if (first_ && !several_) distortion.wall_angle = std::atan2((*first_)[1], (*first_)[0]) / 2.0;
  }

 private:
  /// The angle between two directors: half of that between (Q11, Q12).
  static double between(const Point& a, const Point& b) {
    return std::abs(std::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1])) / 2.0;
  }

  double largest_ = 0.0;
  std::optional<Point> first_;
  bool several_ = false;
};

/// Points that carry an order tensor: particles, then what lies behind the walls.
struct Carriers {
  std::vector<Point> points;
  std::array<std::vector<double>, 2> tensor;
  WallJump jump;
};

Carriers with_dummies(const std::array<std::vector<double>, 2>& tensor,
                      const std::array<std::vector<double>, 3>& position, const Scene& scene,
                      const Boundary& boundary) {
  Carriers all{{}, tensor, {}};
  for (std::size_t i = 0; i < position[0].size(); ++i) all.points.push_back({position[0][i], position[1][i]});
  Dummies dummies;
  boundary.dummies(scene, scene.support, dummies);
  if (dummies.position.empty()) return all;
  std::vector<Extension> extension(2 * dummies.position.size());
  boundary.extend(scene, "order_tensor", 2, dummies, extension);
  const PointCells<2> particles(scene, all.points, scene.spacing);
  for (std::size_t n = 0; n < dummies.position.size(); ++n) {
    const auto source = static_cast<std::size_t>(nearest(particles, point_of(dummies.mirror[n]), scene.spacing));
    for (std::size_t c = 0; c < 2; ++c)
      all.tensor[c].push_back(extension[2 * n + c].factor * tensor[c][source] + extension[2 * n + c].summand);
    const Point place = point_of(dummies.position[n]);
    const Point mirror = point_of(dummies.mirror[n]);
    if (std::hypot(place[0] - mirror[0], place[1] - mirror[1]) < next_to_wall * scene.spacing)
      all.jump.add(&extension[2 * n], {tensor[0][source], tensor[1][source]});
    all.points.push_back(place);
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
  const Carriers all = with_dummies(tensor, position, scene, boundary);
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
  all.jump.tell(distortion);
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
