/// The mean flow around defects, in the frame of the defect.
///
/// The frame has its origin at the defect and its x axis along the defect's orientation: +1/2, from the head of the
/// comet (x < 0) to its tail (x > 0), so an extensile defect moves toward x < 0; -1/2, along one of its three legs. The
/// velocity is that of the lab, turned into the frame, but without the defect's own motion taken off: at the origin of
/// a +1/2 it is the velocity with which the flow carries the defect. A -1/2 looks the same along each leg, so it is
/// looked at three times, and the mean flow is threefold exactly.
///
/// In a square around each defect, values at a lattice of points are fitted to the particles around (local_fit.hpp);
/// points beyond a wall are left out. The mean is over all defects of all samples so far, one vote each.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "local_fit.hpp"
#include "mesogen/diagnostics/error.hpp"
#include "mesogen/neighbours/point_cells.hpp"
#include "mesogen/nematics/defect_search.hpp"
#include "mesogen/plugin/observer.hpp"
#include "mesogen/plugin/plugin.hpp"
#include "mesogen/plugin/stored_positions.hpp"
#include "mesogen/sph/kernel_function.hpp"

namespace mesogen {
namespace {

using Flow = LocalFit<3>;  // u, v, vorticity

/// A defect as it is looked at: the place and the direction of the x axis, rad.
struct View {
  std::array<double, 2> origin{};
  double angle = 0.0;
};

/// A lattice of points around a defect, and what was seen there.
class Patch {
 public:
  Patch() = default;
  /// `points` along each edge, from -radius to radius, m.
  Patch(std::int64_t points, double radius)
      : points_(static_cast<std::size_t>(points)), radius_(radius), sums_(points_ * points_ * numbers, 0.0) {}

  template <class Kernel>
  void look(const std::vector<View>& views, const Flow& flow, const Kernel& kernel, const Scene& scene) {
    const auto count = static_cast<std::ptrdiff_t>(points_ * points_);
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t n = 0; n < count; ++n) {
      const auto [x, y] = place(static_cast<std::size_t>(n));
      double* sum = &sums_[static_cast<std::size_t>(n) * numbers];
      for (const View& view : views) {
        const double c = std::cos(view.angle);
        const double s = std::sin(view.angle);
        const std::array<double, 2> there{view.origin[0] + c * x - s * y, view.origin[1] + s * x + c * y};
        if (beyond_a_wall(there, scene)) continue;
        const auto [u, v, vorticity] = flow.at(there, kernel);
        sum[0] += c * u + s * v;
        sum[1] += c * v - s * u;
        sum[2] += vorticity;
        sum[3] += 1.0;
      }
    }
  }

  /// A row a point: x, y, u, v, vorticity; NaN where nothing was seen.
  [[nodiscard]] std::vector<double> rows() const {
    std::vector<double> rows;
    rows.reserve(points_ * points_ * 5);
    for (std::size_t n = 0; n < points_ * points_; ++n) {
      const auto [x, y] = place(n);
      const double* sum = &sums_[n * numbers];
      rows.insert(rows.end(), {x, y, sum[0] / sum[3], sum[1] / sum[3], sum[2] / sum[3]});
    }
    return rows;
  }

  [[nodiscard]] const std::vector<double>& sums() const { return sums_; }
  void restore(const std::vector<double>& sums) { sums_ = sums; }

 private:
  static constexpr std::size_t numbers = 4;  // a point: sums of u, v and vorticity, and of how many

  [[nodiscard]] std::array<double, 2> place(std::size_t n) const {
    const auto along = [this](std::size_t at) {
      // Integers first, so that the middle is 0 and opposite points are opposite to the last bit.
      const auto steps = static_cast<double>(points_) - 1.0;
      return radius_ * ((2.0 * static_cast<double>(at) - steps) / steps);
    };
    return {along(n % points_), along(n / points_)};
  }

  static bool beyond_a_wall(const std::array<double, 2>& there, const Scene& scene) {
    for (std::size_t d = 0; d < 2; ++d)
      if (!scene.periodic[d] && (there[d] < 0.0 || there[d] > scene.box[d])) return true;
    return false;
  }

  std::size_t points_ = 0;
  double radius_ = 0.0;
  std::vector<double> sums_;
};

/// Those that are at least `distance`, m, away from every other, whatever its charge.
std::vector<nematics::Defect> isolated(const std::vector<nematics::Defect>& defects, const Scene& scene,
                                       double distance) {
  std::vector<std::array<double, 2>> points;
  for (const auto& defect : defects) points.push_back(defect.position);
  const double radius = std::min(distance, std::hypot(scene.box[0], scene.box[1]));  // none is farther away
  const PointCells<2> cells(scene, points, radius);
  std::vector<nematics::Defect> kept;
  for (std::size_t i = 0; i < defects.size(); ++i) {
    bool alone = true;
    cells.within(points[i], radius, [&](Index j, const auto&, double square) {
      if (static_cast<std::size_t>(j) != i && square < distance * distance) alone = false;
    });
    if (alone) kept.push_back(defects[i]);
  }
  return kept;
}

class DefectFlow final : public Observer {
 public:
  static constexpr DimensionSet dimensions{2};

  void parameters(ParameterList& list) override {
    list.number_or("radius", radius_, "auto")
        .unit("m")
        .above(0.0)
        .doc("half the edge of the square around a defect; auto: a sixth of the shortest edge of the box");
    list.integer("points", points_)
        .at_least(3.0)
        .at_most(1001.0)
        .doc("points along an edge of the square; odd, so that the defect is at one of them");
    list.number("isolation", isolation_)
        .unit("m")
        .at_least(0.0)
        .doc("defects closer than this to another defect, of any charge, are left out");
    search_.parameters(list);
  }

  void plan(const Scene& scene, ObserverPlan& plan) override {
    const auto fail = [](const std::string& text) { throw Error(ExitCode::bad_case, "defect_flow: " + text); };
    if (points_ % 2 == 0)
      fail("`points` must be odd, so that the defect is at one of them, but is " + std::to_string(points_));
    const double shortest = std::min(scene.box[0], scene.box[1]);
    if (radius_ && *radius_ > 0.5 * shortest)
      fail("`radius` is at most half the shortest edge of the box, " + std::to_string(0.5 * shortest) + ", but is " +
           std::to_string(*radius_));
    plus_ = minus_ = Patch(points_, radius_.value_or(shortest / 6.0));
    plan.reads("order_tensor");
    plan.reads("velocity");
    plan.reads_if_present("velocity_gradient");
    plan.scalar("count_plus").doc("number of +1/2 defects in the mean, summed over all samples so far");
    plan.scalar("count_minus").doc("number of -1/2 defects in the mean, summed over all samples so far");
    plan.scalar("left_out")
        .doc(
            "number of defects left out of both means because another is closer than `isolation`, summed over all "
            "samples so far");
    for (const auto* name : {"plus", "minus"})
      plan.table(name, 5)
          .unit("m, m, m/s, m/s, 1/s")
          .doc("mean flow around a " + std::string(name == std::string("plus") ? "+1/2" : "-1/2") +
               " defect so far, one row per point, x fastest: x, y, u, v and vorticity along the axes of the defect (x "
               "axis: " +
               (name == std::string("plus") ? "from head to tail" : "along a leg") +
               "). Velocities are relative to the box, not to the defect. NaN at points without data; vorticity is NaN "
               "without velocity_gradient");
  }

  void sample(const ObserverContext& context, Sample& sample) override {
    const Scene& scene = context.scene();
    const auto all = search_.find(context);
    const auto defects = isolated(all, scene, isolation_);
    left_out_ += static_cast<double>(all.size() - defects.size());
    std::vector<View> comets;
    std::vector<View> legs;
    for (const auto& defect : defects) {
      if (defect.charge > 0.0) {
        comets.push_back({defect.position, defect.orientation});
        count_plus_ += 1.0;
        continue;
      }
      for (int leg = 0; leg < 3; ++leg)
        legs.push_back({defect.position, defect.orientation + leg * (2.0 * std::numbers::pi / 3.0)});
      count_minus_ += 1.0;
    }
    sph::SmoothingKernel kernel = context.kernel();
    kernel.smoothing_length = search_.smoothing_length * scene.spacing;
    kernel.scale = 1.0;  // only the ratio of weights matters
    const Flow flow = flow_of(context, kernel.radius());
    sph::with_kernel_function<double>(kernel, [&](const auto& function) {
      plus_.look(comets, flow, function, scene);
      minus_.look(legs, flow, function, scene);
    });
    sample.set("count_plus", count_plus_);
    sample.set("count_minus", count_minus_);
    sample.set("left_out", left_out_);
    sample.set("plus", plus_.rows());
    sample.set("minus", minus_.rows());
  }

  [[nodiscard]] std::map<std::string, std::vector<double>> save() const override {
    return {{"counts", {count_plus_, count_minus_, left_out_}}, {"plus", plus_.sums()}, {"minus", minus_.sums()}};
  }

  void restore(const std::map<std::string, std::vector<double>>& saved) override {
    count_plus_ = saved.at("counts").at(0);
    count_minus_ = saved.at("counts").at(1);
    left_out_ = saved.at("counts").at(2);
    plus_.restore(saved.at("plus"));
    minus_.restore(saved.at("minus"));
  }

 private:
  static Flow flow_of(const ObserverContext& context, double radius) {
    const auto u = context.values("velocity", 0);
    const auto v = context.values("velocity", 1);
    std::vector<double> vorticity(u.size(), std::numeric_limits<double>::quiet_NaN());
    if (context.has("velocity_gradient")) {
      const auto dv_dx = context.values("velocity_gradient", 2);
      const auto du_dy = context.values("velocity_gradient", 1);
      for (std::size_t i = 0; i < vorticity.size(); ++i) vorticity[i] = dv_dx[i] - du_dy[i];
    }
    std::vector<Flow::Values> values(u.size());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = {u[i], v[i], vorticity[i]};
    return {context.scene(), stored_positions<2>(context), std::move(values), radius};
  }

  std::optional<double> radius_;
  std::int64_t points_ = 41;
  double isolation_ = 0.0;
  nematics::DefectSearch search_;

  double count_plus_ = 0.0;  // so far
  double count_minus_ = 0.0;
  double left_out_ = 0.0;
  Patch plus_;
  Patch minus_;
};

}  // namespace
}  // namespace mesogen

MESOGEN_OBSERVER_PLUGIN(mesogen::DefectFlow, "defect_flow", "1.0.0", "Mean flow around defects, in the defect's frame")
