// Structure functions of the velocity: mean squares of the difference of velocity between two points, by their
// distance.
//
//   longitudinal: <((u(x + r) - u(x)) . r/|r|)^2>,   transverse: the rest of <|u(x + r) - u(x)|^2> / (Dim - 1)
//
// (Kolmogorov 1941). What falls and rises in them tells the size of vortices; no grid is needed.

#include <algorithm>
#include <cmath>
#include <optional>

#include "mesogen/exec/compensated_sum.hpp"
#include "mesogen/neighbours/point_cells.hpp"
#include "mesogen/plugin/by_id.hpp"
#include "mesogen/plugin/observer.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

class StructureFunction final : public Observer {
 public:
  static constexpr DimensionSet dimensions{2};

  void parameters(ParameterList& list) override {
    list.integer("bins", bins_).unit("1").at_least(1).at_most(10000).doc("number of distances, all of the same width");
    list.number_or("largest", largest_, "auto").unit("m").above(0).doc("largest distance; auto: a quarter of the box");
    list.integer("centres", centres_)
        .unit("1")
        .at_least(1)
        .doc(
            "number of particles, spread evenly over the ids, whose surroundings are searched; the cost is "
            "proportional to it");
  }

  void plan(const Scene&, ObserverPlan& plan) override {
    plan.reads("velocity");
    plan.table("structure_function", 4)
        .unit("m, m2/s2, m2/s2, 1")
        .doc("one row per distance: mean distance, longitudinal and transverse structure function, number of pairs");
  }

  void sample(const ObserverContext& context, Sample& sample) override {
    const Scene& scene = context.scene();
    const double largest = largest_.value_or(0.25 * std::min(scene.box[0], scene.box[1]));
    const ById particles(context);
    const auto points = particles.positions<2>();
    const auto u = particles.values("velocity", 0);
    const auto v = particles.values("velocity", 1);
    const PointCells<2> cells(scene, points, largest / 4.0);
    std::vector<Bin> bins(static_cast<std::size_t>(bins_));
    const std::size_t centres = std::min(points.size(), static_cast<std::size_t>(centres_));
    for (std::size_t n = 0; n < centres; ++n) {
      const std::size_t i = n * points.size() / centres;
      cells.within(points[i], largest, [&](Index j, const auto& way, double square) {
        const double distance = std::sqrt(square);
        const auto bin = static_cast<std::size_t>(distance / largest * static_cast<double>(bins_));
        if (square == 0.0 || bin >= bins.size()) return;
        const double du = u[static_cast<std::size_t>(j)] - u[i];
        const double dv = v[static_cast<std::size_t>(j)] - v[i];
        const double along = (du * way[0] + dv * way[1]) / distance;
        bins[bin].add(distance, along * along, du * du + dv * dv - along * along);
      });
    }
    std::vector<double> rows;
    for (const Bin& bin : bins) bin.write(rows);
    sample.set("structure_function", std::move(rows));
  }

 private:
  struct Bin {
    exec::CompensatedSum distance, longitudinal, transverse;
    double pairs = 0.0;

    void add(double r, double along, double across) {
      distance.add(r);
      longitudinal.add(along);
      transverse.add(across);
      pairs += 1.0;
    }
    /// NaN where no pair was found.
    void write(std::vector<double>& rows) const {
      rows.insert(rows.end(),
                  {distance.value() / pairs, longitudinal.value() / pairs, transverse.value() / pairs, pairs});
    }
  };

  std::int64_t bins_ = 50;
  std::optional<double> largest_;
  std::int64_t centres_ = 2000;
};

}  // namespace

MESOGEN_OBSERVER_PLUGIN(StructureFunction, "structure_function", "1.0.0",
                        "Structure functions of the velocity, along and across the distance")
