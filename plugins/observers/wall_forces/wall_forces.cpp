/// What the fluid does to its walls: force and torque on each, by pressure, viscosity, activity and elasticity.
///
/// Stresses are carried from the particles near the surface to its elements by moving least squares, exactly where they
/// are linear, and added up over the surface: F = sum_e sigma . n dA, n into the fluid.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "mesogen/exec/dispatch.hpp"
#include "mesogen/neighbours/point_cells.hpp"
#include "mesogen/plugin/observer.hpp"
#include "mesogen/plugin/plugin.hpp"
#include "mesogen/plugin/stored_positions.hpp"
#include "mesogen/sph/smoothing_kernel.hpp"

namespace mesogen {
namespace {

/// A stress, and the quantity of its force.
struct Part {
  const char* field;
  const char* quantity;
  const char* of;
};
constexpr std::array parts{
    Part{"pressure", "pressure_force", "the pressure"}, Part{"stress_viscous", "viscous_force", "viscosity"},
    Part{"stress_active", "active_force", "activity"}, Part{"stress_elastic", "elastic_force", "elasticity"}};

constexpr std::size_t viscous = 1;

struct Weight {
  Index particle;
  double value;
};

/// Weights of the particles around a point by which a linear field has its value there. Of the mean where particles do
/// not span a linear function.
template <int Dim>
std::vector<Weight> weights_at(const PointCells<Dim>& cells, const std::array<double, 3>& point, double radius) {
  struct Near {
    Index particle;
    double weight;
    std::array<double, Dim> way;
  };
  std::vector<Near> near;
  typename PointCells<Dim>::Point at;
  std::copy_n(point.begin(), Dim, at.begin());
  cells.within(at, radius, [&](Index j, const auto& way, double square) {
    const double rest = 1.0 - std::sqrt(square) / radius;
    near.push_back({j, rest * rest * rest * rest * (5.0 - 4.0 * rest), way});
  });
  constexpr int size = Dim + 1;
  std::array<std::array<double, size + 1>, size> system{};  // of the moments, and the first unit vector
  system[0][size] = 1.0;
  for (const Near& one : near)
    for (int a = 0; a < size; ++a)
      for (int b = 0; b < size; ++b)
        system[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)] +=
            one.weight * (a == 0 ? 1.0 : one.way[static_cast<std::size_t>(a - 1)] / radius) *
            (b == 0 ? 1.0 : one.way[static_cast<std::size_t>(b - 1)] / radius);
  const double total = system[0][0];
  bool spans = total > 0.0;
  for (std::size_t a = 0; a < size && spans; ++a) {  // symmetric and positive: no pivots are needed
    spans = system[a][a] > 1e-6 * total;
    for (std::size_t b = 0; b < size && spans; ++b) {
      if (b == a) continue;
      const double share = system[b][a] / system[a][a];
      for (std::size_t c = 0; c <= size; ++c) system[b][c] -= share * system[a][c];
    }
  }
  std::vector<Weight> weights;
  for (const Near& one : near) {
    double linear = spans ? system[0][size] / system[0][0] : 1.0 / total;
    for (std::size_t d = 0; d < Dim && spans; ++d)
      linear += system[d + 1][size] / system[d + 1][d + 1] * one.way[d] / radius;
    weights.push_back({one.particle, one.weight * linear});
  }
  return weights;
}

class WallForces final : public Observer {
 public:
  static constexpr DimensionSet dimensions{2};

  void plan(const Scene& scene, ObserverPlan& plan) override {
    for (const Part& part : parts) plan.reads_if_present(part.field);
    std::string rows = "one row for each wall: ";
    for (const WallSurface& surface : scene.surfaces) rows += (rows.back() == ' ' ? "" : ", ") + surface.name;
    if (scene.surfaces.empty()) rows += "faces of the box that are not periodic (x_low, x_high, ...), then solids";
    plan.table("force", dimension).unit("N/m").doc("force of the fluid on the wall, per metre of depth; " + rows);
    plan.table("torque", 1).unit("N").doc("torque of that force about the centre of the shape, or of the box");
    for (const Part& part : parts)
      plan.table(part.quantity, dimension).unit("N/m").doc(std::string("the part of ") + part.of);
    plan.table("length", 1).unit("m").doc("length of the surface");
  }

  void sample(const ObserverContext& context, Sample& sample) override {
    const Scene& scene = context.scene();
    std::vector<FieldReader> stress;
    std::vector<std::size_t> part_of;
    for (std::size_t n = 0; n < parts.size(); ++n)
      if (context.has(parts[n].field)) {
        stress.push_back(context.field(parts[n].field));
        part_of.push_back(n);
      }
    // The half of a support is there: nearer particles say more of the surface.
    const double radius = 0.65 * context.kernel().radius();
    const PointCells<dimension> cells(scene, stored_positions<dimension>(context), radius / 2.0);
    std::array<std::vector<double>, parts.size()> of_part;
    std::vector<double> force, torque, length;
    for (const WallSurface& surface : scene.surfaces) {
      std::array<double, parts.size() * dimension> sum{};
      double turning = 0.0;
      double whole = 0.0;
      for (const SurfaceElement& element : surface.elements) {
        const auto weights = weights_at<dimension>(cells, element.point, radius);
        std::array<double, dimension> on_element{};
        for (std::size_t n = 0; n < stress.size(); ++n) {
          auto traction = traction_of(stress[n], part_of[n] == 0, weights, element);
          if (part_of[n] == viscous && surface.sticks) drop_normal(traction, element);
          for (std::size_t d = 0; d < dimension; ++d) {
            sum[part_of[n] * dimension + d] += traction[d];
            on_element[d] += traction[d];
          }
        }
        turning += arm(scene, surface, element, 0) * on_element[1] - arm(scene, surface, element, 1) * on_element[0];
        whole += element.area;
      }
      for (std::size_t d = 0; d < dimension; ++d) {
        double total = 0.0;
        for (std::size_t n = 0; n < parts.size(); ++n) {
          const double part = sum[n * dimension + d];
          of_part[n].push_back(part);
          total += part;
        }
        force.push_back(total);
      }
      torque.push_back(turning);
      length.push_back(whole);
    }
    sample.set("force", force);
    sample.set("torque", torque);
    for (std::size_t n = 0; n < parts.size(); ++n) sample.set(parts[n].quantity, of_part[n]);
    sample.set("length", length);
  }

 private:
  static constexpr int dimension = 2;

  static double arm(const Scene& scene, const WallSurface& surface, const SurfaceElement& element, std::size_t axis) {
    const double way = element.point[axis] - surface.centre[axis];
    return scene.periodic[axis] ? std::remainder(way, scene.box[axis]) : way;
  }

  // Where the fluid sticks its velocity along the normal has no slope there, as it has no divergence; a slope that is
  // summed over neighbours has.
  static void drop_normal(std::array<double, dimension>& traction, const SurfaceElement& element) {
    const double along = traction[0] * element.normal[0] + traction[1] * element.normal[1];
    for (std::size_t d = 0; d < dimension; ++d) traction[d] -= along * element.normal[d];
  }

  static std::array<double, dimension> traction_of(const FieldReader& stress, bool pressure,
                                                   const std::vector<Weight>& weights, const SurfaceElement& element) {
    std::array<double, dimension> traction{};
    for (int a = 0; a < dimension; ++a)
      for (int b = 0; b < dimension; ++b) {
        if (pressure && a != b) continue;
        double value = 0.0;
        for (const Weight& one : weights)
          value += one.value * (pressure ? -stress(0, one.particle) : stress(a * dimension + b, one.particle));
        traction[static_cast<std::size_t>(a)] += value * element.normal[static_cast<std::size_t>(b)] * element.area;
      }
    return traction;
  }
};

}  // namespace
}  // namespace mesogen

MESOGEN_OBSERVER_PLUGIN(mesogen::WallForces, "wall_forces", "1.0.0",
                        "Force and torque on each wall, by pressure, viscosity, activity and elasticity")
