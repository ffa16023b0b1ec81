#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "contract_run.hpp"

namespace mesogen::testing {

namespace {

using Point = Shape::Point;

/// Points of a grid over the box.
std::vector<Point> points_of(const Scene& scene) {
  constexpr int along = 60;
  std::vector<Point> points;
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < along; ++i)
      points.push_back({(i + 0.5) / along * scene.box[0], (j + 0.5) / along * scene.box[1], 0.0});
  return points;
}

Point slope_of(const Shape& shape, const Point& at, double step, int dimension) {
  Point slope{};
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d) {
    Point there = at;
    there[d] = at[d] + step;
    slope[d] = shape.distance(there);
    there[d] = at[d] - step;
    slope[d] = (slope[d] - shape.distance(there)) / (2.0 * step);
  }
  return slope;
}

std::string distance_problem(const Shape& shape, const Scene& scene) {
  int near = 0;
  int wrong = 0;
  std::string first;
  for (const Point& at : points_of(scene)) {
    const double distance = shape.distance(at);
    if (!std::isfinite(distance)) return fmt::format("it is {} at ({:.4g}, {:.4g}) m", distance, at[0], at[1]);
    if (std::abs(distance) > scene.support) continue;
    ++near;
    const Point slope = slope_of(shape, at, 1e-5 * scene.spacing, scene.dimension);
    const double length = std::hypot(slope[0], slope[1], slope[2]);
    if (std::abs(length - 1.0) < 0.02) continue;
    if (++wrong == 1)
      first = fmt::format("at ({:.4g}, {:.4g}) m, {:.3g} m from the surface, its slope is {:.4g} instead of 1", at[0],
                          at[1], distance, length);
  }
  if (near == 0) return "no point of the box is near its surface: choose parameters with --set";
  // Where two parts of the surface are equally near there is a crease.
  if (wrong > near / 10) return first + fmt::format("; so it is at {} of {} points near the surface", wrong, near);
  return {};
}

}  // namespace

void check_shape(ContractRun& run) {
  run.check("its distance grows by a metre for each metre from the surface", [&] {
    PluginHarness harness = run.harness();
    const Scene scene = harness.scene();
    return distance_problem(harness.shape(), scene);
  });
  run.check("particles fill what it leaves, as evenly as on a lattice to 15 %", [&]() -> std::string {
    TestScene scene;
    scene.arrangement = "lattice";
    scene.across = 40;
    PluginHarness harness = run.harness(scene);
    const double mean = std::pow(harness.scene().spacing, harness.scene().dimension);
    const auto volume = harness.values("volume");
    const auto x = harness.position(0);
    const auto y = harness.position(1);
    for (std::size_t id = 0; id < volume.size(); ++id)
      if (!(std::abs(volume[id] / mean - 1.0) < 0.15))
        return fmt::format("the volume of the particle at ({:.4g}, {:.4g}) m is {:.3g} of that on a lattice", x[id],
                           y[id], volume[id] / mean);
    return {};
  });
  run.check("the same input gives the same bits, again and with 3 threads", [&]() -> std::string {
    const auto positions = [&](int threads) {
      return with_threads(threads, [&] {
        PluginHarness harness = run.harness();
        Numbers numbers;
        for (int d = 0; d < harness.scene().dimension; ++d)
          numbers[fmt::format("position {}", d)] = harness.position(d);
        return numbers;
      });
    };
    const Numbers first = positions(1);
    const std::string problem = difference(first, positions(1));
    if (!problem.empty()) return problem + ": distance() must depend on its argument and the parameters alone";
    return difference(first, positions(3));
  });
}

}  // namespace mesogen::testing
