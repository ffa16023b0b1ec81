/// How a flow stands: speeds, vorticity, energy, and how evenly the particles fill the box.
///
/// Averages <f> = sum_i f_i / N are over particles. The mass of a particle is <density> * (area of the box) / N, equal
/// for all: each carries the fluid that it started with. `volume` (1 / sum_j W_ij) says how evenly they are spread.
/// Masses and densities are those of the fluid, also where a creeping flow is computed with an artificial density.
/// Quantities whose fields the scene does not have are NaN.
#include <algorithm>
#include <cmath>
#include <limits>

#include "mesogen/exec/compensated_sum.hpp"
#include "mesogen/exec/dispatch.hpp"
#include "mesogen/neighbours/point_cells.hpp"
#include "mesogen/plugin/by_id.hpp"
#include "mesogen/plugin/observer.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace mesogen {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

double mean(const std::vector<double>& values) {
  exec::CompensatedSum sum;
  for (const double x : values) sum.add(x);
  return sum.value() / static_cast<double>(values.size());
}

double volume_of_box(const Scene& scene) {
  double volume = 1.0;
  for (int d = 0; d < scene.dimension; ++d) volume *= scene.box[static_cast<std::size_t>(d)];
  return volume;
}

/// Smallest distance between two particles, m.
template <int Dim>
double smallest_distance(const Scene& scene, const std::vector<std::array<double, Dim>>& points) {
  const double volume = volume_of_box(scene);
  // However they are placed, two of N particles are closer than in the densest packing: 1.075 (V/N)^(1/2) in 2D,
  // 1.123 (V/N)^(1/3) in 3D. So one of these searches finds the closest pair.
  const double radius = 1.13 * std::pow(volume / static_cast<double>(points.size()), 1.0 / Dim);
  const PointCells<Dim> cells(scene, points, radius);
  double smallest = std::numeric_limits<double>::infinity();
  const auto count = static_cast<Index>(points.size());
#pragma omp parallel for schedule(static) reduction(min : smallest)
  for (Index i = 0; i < count; ++i) {
    cells.within(points[static_cast<std::size_t>(i)], radius, [&](Index j, const auto&, double square) {
      if (j != i) smallest = std::min(smallest, square);
    });
  }
  return std::isfinite(smallest) ? std::sqrt(smallest) : none;
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
    plan.scalar("kinetic_energy").unit(plane ? "J/m" : "J").doc("sum of m u.u / 2, m = <density> * box / N");
    plan.scalar("compression_energy")
        .unit(plane ? "J/m" : "J")
        .doc("energy stored by compression: sum of internal_energy * box / N");
    plan.table("total_momentum", static_cast<std::size_t>(scene.dimension))
        .unit(plane ? "kg/s" : "kg m/s")
        .doc("sum of m u: one row, one column per axis; in 2D per metre of depth");
    plan.scalar("density_min").unit("kg/m^3").doc("smallest density of a particle");
    plan.scalar("density_max").unit("kg/m^3").doc("largest density of a particle");
    plan.scalar("volume_min").doc("smallest volume of a particle over the mean, V / V0, V0 = box / N");
    plan.scalar("volume_max").doc("largest volume of a particle over the mean, V / V0");
    plan.scalar("min_spacing").doc("smallest distance between two particles, in initial spacings");
  }

  void sample(const ObserverContext& context, Sample& sample) override {
    const ById particles(context);
    motion(context, particles, sample);
    sample.set("compression_energy", compression_energy(context, particles));
    gradient(context, particles, sample);
    filling(context, particles, sample);
  }

 private:
  /// Physical density over that of the momentum equation: a creeping flow is computed with an artificial one.
  static double physical_share(const ObserverContext& context) {
    const double physical = context.constant("physical_density");
    return std::isnan(physical) ? 1.0 : physical / context.constant("density");
  }

  /// Mass of a particle, kg (2D: kg/m); from the constant `density` where there is no such field. NaN if unknown.
  static double mass(const ObserverContext& context, const ById& particles) {
    const double density = context.has("density") ? mean(particles.values("density")) : context.constant("density");
    return physical_share(context) * density * volume_of_box(context.scene()) / static_cast<double>(particles.count());
  }

  static void motion(const ObserverContext& context, const ById& particles, Sample& sample) {
    const int dimension = context.scene().dimension;
    std::vector<double> momentum(static_cast<std::size_t>(dimension), none);
    if (!context.has("velocity")) {
      sample.set("v_rms", none);
      sample.set("kinetic_energy", none);
      sample.set("total_momentum", momentum);
      return;
    }
    const double m = mass(context, particles);
    exec::CompensatedSum squares;
    for (int d = 0; d < dimension; ++d) {
      exec::CompensatedSum sum;
      for (const double u : particles.values("velocity", d)) {
        sum.add(u);
        squares.add(u * u);
      }
      momentum[static_cast<std::size_t>(d)] = m * sum.value();
    }
    sample.set("v_rms", std::sqrt(squares.value() / static_cast<double>(particles.count())));
    sample.set("kinetic_energy", 0.5 * m * squares.value());
    sample.set("total_momentum", momentum);
  }

  /// Per volume at rest, which is the same for all particles.
  static double compression_energy(const ObserverContext& context, const ById& particles) {
    return context.has("internal_energy") ? mean(particles.values("internal_energy")) * volume_of_box(context.scene())
                                          : none;
  }

  static void gradient(const ObserverContext& context, const ById& particles, Sample& sample) {
    if (!context.has("velocity_gradient")) {
      sample.set("vorticity_rms", none);
      sample.set("divergence_rms", none);
      return;
    }
    const auto dimension = static_cast<std::size_t>(context.scene().dimension);
    std::vector<std::vector<double>> slope(dimension * dimension);  // du_c/dx_d as c * dimension + d
    for (std::size_t c = 0; c < slope.size(); ++c)
      slope[c] = particles.values("velocity_gradient", static_cast<int>(c));
    const auto at = [&](std::size_t c, std::size_t d, std::size_t i) { return slope[c * dimension + d][i]; };
    exec::CompensatedSum vorticity;
    exec::CompensatedSum divergence;
    for (std::size_t i = 0; i < particles.count(); ++i) {
      double trace = 0.0;
      for (std::size_t c = 0; c < dimension; ++c) {
        trace += at(c, c, i);
        for (std::size_t d = 0; d < c; ++d) vorticity.add(std::pow(at(c, d, i) - at(d, c, i), 2));
      }
      divergence.add(trace * trace);
    }
    const auto count = static_cast<double>(particles.count());
    sample.set("vorticity_rms", std::sqrt(vorticity.value() / count));
    sample.set("divergence_rms", std::sqrt(divergence.value() / count));
  }

  static void filling(const ObserverContext& context, const ById& particles, Sample& sample) {
    const Scene& scene = context.scene();
    sample.set("density_min", none);
    sample.set("density_max", none);
    if (context.has("density")) {
      const auto density = particles.values("density");
      const auto [low, high] = std::minmax_element(density.begin(), density.end());
      sample.set("density_min", *low * physical_share(context));
      sample.set("density_max", *high * physical_share(context));
    }
    const auto volume = particles.values("volume");
    const double mean_volume = volume_of_box(scene) / static_cast<double>(particles.count());
    const auto [low, high] = std::minmax_element(volume.begin(), volume.end());
    sample.set("volume_min", *low / mean_volume);
    sample.set("volume_max", *high / mean_volume);
    const double distance = dispatch<AllDimensions>(
        scene.dimension, [&]<int Dim>() { return smallest_distance<Dim>(scene, particles.positions<Dim>()); });
    sample.set("min_spacing", distance / scene.spacing);
  }
};

}  // namespace
}  // namespace mesogen

MESOGEN_OBSERVER_PLUGIN(mesogen::FlowStatistics, "flow_statistics", "1.0.0",
                        "Speeds, vorticity, energy, momentum, and how evenly particles fill the box")
