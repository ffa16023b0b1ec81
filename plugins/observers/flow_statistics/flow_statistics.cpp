/// How a flow stands: speeds, vorticity, energy, and how evenly the particles fill the box.
///
/// Averages <f> = sum_i f_i / N are over particles. The mass of a particle is <density> * (area of the box) / N, equal
/// for all: each carries the fluid that it started with. `volume` (1 / sum_j W_ij) says how evenly they are spread.
/// Masses and densities are those of the fluid, also where a creeping flow is computed with an artificial density.
/// Quantities whose fields the scene does not have are NaN.
#include <algorithm>
#include <cmath>
#include <limits>

#include "mesogen/exec/dispatch.hpp"
#include "mesogen/exec/exact_sum.hpp"
#include "mesogen/neighbours/point_cells.hpp"
#include "mesogen/plugin/observer.hpp"
#include "mesogen/plugin/plugin.hpp"
#include "mesogen/plugin/stored_positions.hpp"

namespace mesogen {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

double count_of(const ObserverContext& context) { return context.count(); }

double mean(const ObserverContext& context, std::string_view name) {
  const FieldReader field = context.field(name);
  const auto [sum] = exec::exact_sums<1>(context.count(), [&](Index i, double(&term)[1]) { term[0] = field(i); });
  return sum / count_of(context);
}

struct Range {
  double lowest, highest;
};

Range range(const ObserverContext& context, std::string_view name) {
  const FieldReader field = context.field(name);
  const Index count = context.count();
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
#pragma omp parallel for schedule(static) reduction(min : lowest) reduction(max : highest)
  for (Index i = 0; i < count; ++i) {
    lowest = std::min(lowest, field(i));
    highest = std::max(highest, field(i));
  }
  return {lowest, highest};
}

/// Smallest distance between two particles, m.
template <int Dim>
double smallest_distance(const ObserverContext& context) {
  // However they are placed, two of N particles are closer than in the densest packing: 1.075 (V/N)^(1/2) in 2D,
  // 1.123 (V/N)^(1/3) in 3D. So cells of this width find the closest pair.
  const double width = 1.13 * std::pow(context.scene().fluid_volume / count_of(context), 1.0 / Dim);
  const PointCells<Dim> cells(context.scene(), stored_positions<Dim>(context), width);
  const double square = cells.closest_square();
  return std::isfinite(square) ? std::sqrt(square) : none;
}

class FlowStatistics final : public Observer {
 public:
  void plan(const Scene& scene, ObserverPlan& plan) override {
    for (const auto* field : {"velocity", "velocity_gradient", "density", "internal_energy"})
      plan.reads_if_present(field);
    plan.reads("volume");
    const bool plane = scene.dimension == 2;  // per metre of depth
    plan.scalar("v_rms").unit("m/s").doc("root of the mean square velocity, sqrt(<u.u>)");
    plan.scalar("vorticity_rms").unit("1/s").doc("root of the mean square vorticity, w = dv/dx - du/dy in 2D");
    plan.scalar("divergence_rms").unit("1/s").doc("root of the mean square divergence of the velocity");
    plan.scalar("kinetic_energy").unit(plane ? "J/m" : "J").doc("sum of m u.u / 2, m = <density> * volume / N");
    plan.scalar("compression_energy")
        .unit(plane ? "J/m" : "J")
        .doc("energy stored by compression: sum of internal_energy * volume / N");
    plan.table("total_momentum", static_cast<std::size_t>(scene.dimension))
        .unit(plane ? "kg/s" : "kg m/s")
        .doc("sum of m u: one row, one column per axis; in 2D per metre of depth");
    plan.scalar("density_min").unit("kg/m^3").doc("smallest density of a particle");
    plan.scalar("density_max").unit("kg/m^3").doc("largest density of a particle");
    plan.scalar("volume_min").doc("smallest volume of a particle over the mean, V / V0, V0 = volume / N, of the fluid");
    plan.scalar("volume_max").doc("largest volume of a particle over the mean, V / V0");
    plan.scalar("min_spacing").doc("smallest distance between two particles, in initial spacings");
  }

  void sample(const ObserverContext& context, Sample& sample) override {
    motion(context, sample);
    sample.set("compression_energy", compression_energy(context));
    gradient(context, sample);
    filling(context, sample);
  }

 private:
  /// Physical density over that of the momentum equation: a creeping flow is computed with an artificial one.
  static double physical_share(const ObserverContext& context) {
    const double physical = context.constant("physical_density");
    return std::isnan(physical) ? 1.0 : physical / context.constant("density");
  }

  /// Mass of a particle, kg (2D: kg/m); from the constant `density` where there is no such field. NaN if unknown.
  static double mass(const ObserverContext& context) {
    const double density = context.has("density") ? mean(context, "density") : context.constant("density");
    return physical_share(context) * density * context.scene().fluid_volume / count_of(context);
  }

  static void motion(const ObserverContext& context, Sample& sample) {
    const int dimension = context.scene().dimension;
    std::vector<double> momentum(static_cast<std::size_t>(dimension), none);
    if (!context.has("velocity")) {
      sample.set("v_rms", none);
      sample.set("kinetic_energy", none);
      sample.set("total_momentum", momentum);
      return;
    }
    const double m = mass(context);
    const FieldReader u = context.field("velocity");
    double squares = 0.0;
    for (int d = 0; d < dimension; ++d) {
      const auto [sum, square] = exec::exact_sums<2>(context.count(), [&](Index i, double(&terms)[2]) {
        terms[0] = u(d, i);
        terms[1] = terms[0] * terms[0];
      });
      squares += square;
      momentum[static_cast<std::size_t>(d)] = m * sum;
    }
    sample.set("v_rms", std::sqrt(squares / count_of(context)));
    sample.set("kinetic_energy", 0.5 * m * squares);
    sample.set("total_momentum", momentum);
  }

  /// Per volume at rest, which is the same for all particles.
  static double compression_energy(const ObserverContext& context) {
    return context.has("internal_energy") ? mean(context, "internal_energy") * context.scene().fluid_volume : none;
  }

  static void gradient(const ObserverContext& context, Sample& sample) {
    if (!context.has("velocity_gradient")) {
      sample.set("vorticity_rms", none);
      sample.set("divergence_rms", none);
      return;
    }
    const FieldReader slope = context.field("velocity_gradient");  // du_c/dx_d as c * dimension + d
    const int dimension = context.scene().dimension;
    const auto [vorticity, divergence] = exec::exact_sums<2>(context.count(), [&](Index i, double(&squares)[2]) {
      squares[0] = 0.0;
      double trace = 0.0;
      for (int c = 0; c < dimension; ++c) {
        trace += slope(c * dimension + c, i);
        for (int d = 0; d < c; ++d)
          squares[0] += std::pow(slope(c * dimension + d, i) - slope(d * dimension + c, i), 2);
      }
      squares[1] = trace * trace;
    });
    sample.set("vorticity_rms", std::sqrt(vorticity / count_of(context)));
    sample.set("divergence_rms", std::sqrt(divergence / count_of(context)));
  }

  static void filling(const ObserverContext& context, Sample& sample) {
    const Scene& scene = context.scene();
    sample.set("density_min", none);
    sample.set("density_max", none);
    if (context.has("density")) {
      const Range density = range(context, "density");
      sample.set("density_min", density.lowest * physical_share(context));
      sample.set("density_max", density.highest * physical_share(context));
    }
    const double mean_volume = scene.fluid_volume / count_of(context);
    const Range volume = range(context, "volume");
    sample.set("volume_min", volume.lowest / mean_volume);
    sample.set("volume_max", volume.highest / mean_volume);
    const double distance =
        dispatch<AllDimensions>(scene.dimension, [&]<int Dim>() { return smallest_distance<Dim>(context); });
    sample.set("min_spacing", distance / scene.spacing);
  }
};

}  // namespace
}  // namespace mesogen

MESOGEN_OBSERVER_PLUGIN(mesogen::FlowStatistics, "flow_statistics", "1.0.0",
                        "Speeds, vorticity, energy, momentum, and how evenly particles fill the box")
