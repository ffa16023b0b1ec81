#include "solids/fluid_region.hpp"

#include <cmath>

namespace mesogen {

namespace {

using Point = Shape::Point;

constexpr double sharpest = 0.25;  // curvature times spacing: what is sharper is an edge

Point moved(const Point& from, double by, const Point& along) {
  return {from[0] + by * along[0], from[1] + by * along[1], from[2] + by * along[2]};
}

}  // namespace

FluidRegion::Nearest FluidRegion::nearest(const Point& at) const {
  Nearest least{solids_[0].distance(at), 0};
  for (std::size_t n = 1; n < solids_.size(); ++n)
    if (const double distance = solids_[n].distance(at); distance < least.distance) least = {distance, n};
  return least;
}

// The nearest point of one surface may lie in another solid. From there the way to that one's surface, and back, and so
// on, ends where both meet.
std::optional<FluidRegion::Foot> FluidRegion::foot(const Point& at) const {
  const double close = 1e-6 * scene_.spacing;
  const std::size_t first = nearest(at).solid;
  Foot foot{solids_[first].nearest(at), {}, first};
  for (int n = 0; n < 60; ++n) {
    const Nearest hidden = nearest(foot.point);
    if (hidden.distance > -close) break;
    if (n == 59) return {};
    foot.point = solids_[hidden.solid].nearest(foot.point);
    foot.solid = hidden.solid;
  }
  const Point way = moved(foot.point, -1.0, at);
  const double length = std::hypot(way[0], way[1], way[2]);
  foot.normal = length > 1e-3 * scene_.spacing ? moved({}, 1.0 / length, way) : solids_[foot.solid].normal(foot.point);
  return foot;
}

// Half the Laplacian of the distance is the mean curvature, in two dimensions all of it.
double FluidRegion::curvature(const Foot& at) const {
  const Solid& solid = solids_[at.solid];
  const double step = 0.1 * scene_.spacing;
  double sum = 0.0;
  for (int d = 0; d < scene_.dimension; ++d)
    for (const double way : {-step, step}) {
      Point there = at.point;
      there[static_cast<std::size_t>(d)] += way;
      sum += solid.distance(there) - solid.distance(at.point);
    }
  const double curvature = sum / (step * step * (scene_.dimension - 1));
  return std::abs(curvature) * scene_.spacing < sharpest ? curvature : 0.0;
}

FluidRegion::Point FluidRegion::kept_away(Point at, double least) const {
  for (int n = 0; n < 3; ++n) {
    const Nearest here = nearest(at);
    const double lacks = least > 0.0 ? std::max(0.0, least - here.distance) : std::min(0.0, least - here.distance);
    if (lacks == 0.0) break;
    at = moved(at, lacks, solids_[here.solid].normal(at));
  }
  return at;
}

}  // namespace mesogen
