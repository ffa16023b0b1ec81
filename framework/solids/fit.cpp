#include "solids/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesogen/exec/dispatch.hpp"
#include "mesogen/neighbours/point_cells.hpp"

namespace mesogen {

namespace {

using Point = Shape::Point;

std::string at_text(const Point& at, const std::string& unit) {
  return fmt::format("({:.4g}, {:.4g}) {}", at[0], at[1], unit);
}

/// The narrowest gap between two solids that do not touch.
class Gaps {
 public:
  Gaps(const FluidRegion& region, const Scene& scene) : region_(region), scene_(scene) {}

  std::string problem(const Packing& packing, const std::string& unit) const {
    const double least = 2.0 * scene_.support;
    for (std::size_t a = 0; a < region_.solids().size(); ++a)
      for (std::size_t b = a + 1; b < region_.solids().size(); ++b) {
        const Narrowest narrowest = between(region_.solid(a), region_.solid(b), packing);
        if (narrowest.touch || narrowest.gap >= least) continue;
        return fmt::format(
            "{} and {} are {:.4g} {} apart near {}: the fluid between two solids must be at least two supports of the "
            "kernel wide, {:.4g} {}, or else they must overlap. Move them apart or together, or take smaller particles",
            region_.solid(a).name(), region_.solid(b).name(), narrowest.gap, unit, at_text(narrowest.where, unit),
            least, unit);
      }
    return {};
  }

 private:
  struct Narrowest {
    double gap = std::numeric_limits<double>::infinity();
    Point where{};
    bool touch = false;
  };

  Narrowest between(const Solid& a, const Solid& b, const Packing& packing) const {
    Narrowest narrowest;
    const double near = 0.5 * scene_.spacing;
    for (const Point& at : packing.fluid) {
      const double gap = a.distance(at) + b.distance(at);
      if (gap < narrowest.gap && wets(a.nearest(at)) && wets(b.nearest(at))) narrowest = {gap, at, narrowest.touch};
    }
    for (const auto* const points : {&packing.fluid, &packing.solid})
      for (const Point& at : *points)
        narrowest.touch = narrowest.touch || (a.distance(at) < near && b.distance(at) < near);
    return narrowest;
  }

  /// Is a point of a surface not hidden by another solid?
  [[nodiscard]] bool wets(const Point& surface) const { return region_.distance(surface) > -0.1 * scene_.spacing; }

  const FluidRegion& region_;
  const Scene& scene_;
};

/// Parts of the fluid that no path of neighbouring particles connects.
template <int Dim>
std::string pocket_problem(const Scene& scene, const std::vector<Point>& fluid, const std::string& unit) {
  std::vector<typename PointCells<Dim>::Point> points(fluid.size());
  for (std::size_t n = 0; n < fluid.size(); ++n) std::copy_n(fluid[n].begin(), Dim, points[n].begin());
  const double near = 1.8 * scene.spacing;
  const PointCells<Dim> cells(scene, points, near);
  const auto least = static_cast<std::size_t>(std::pow(scene.support / scene.spacing, Dim));
  std::vector<char> seen(fluid.size());
  std::vector<std::size_t> open;
  for (std::size_t first = 0; first < fluid.size(); ++first) {
    if (seen[first] != 0) continue;
    std::size_t count = 0;
    open = {first};
    seen[first] = 1;
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      ++count;
      cells.within(points[at], near, [&](Index j, const auto&, double) {
        if (auto& one = seen[static_cast<std::size_t>(j)]; one == 0) {
          one = 1;
          open.push_back(static_cast<std::size_t>(j));
        }
      });
    }
    if (count < least)
      return fmt::format(
          "the solids cut off a pocket of {} particles at {}, smaller than the support of the kernel: fill it with a "
          "solid, or take smaller particles",
          count, at_text(fluid[first], unit));
  }
  return {};
}

}  // namespace

std::string fit_problem(const FluidRegion& region, const Scene& scene, const Packing& packing,
                        const std::string& length_unit) {
  if (packing.fluid.empty()) return "the solids fill the whole box: no fluid is left";
  std::vector<char> wets(region.solids().size());
  for (const Point& at : packing.solid) wets[region.nearest(at).solid] = 1;
  for (std::size_t n = 0; n < wets.size(); ++n)
    if (wets[n] == 0)
      return fmt::format("{} touches no fluid: it lies outside of the box, in another solid, or between particles",
                         region.solid(n).name());
  if (std::string problem = Gaps(region, scene).problem(packing, length_unit); !problem.empty()) return problem;
  return dispatch(scene.dimension, [&]<int Dim>() { return pocket_problem<Dim>(scene, packing.fluid, length_unit); });
}

}  // namespace mesogen
