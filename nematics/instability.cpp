#include "mesogen/nematics/instability.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mesogen::nematics {

namespace {

// Waves shorter than that are decided by elasticity: the long ones among them come first.
constexpr int most_waves = 32;

/// The product of the two couplings: of theta to vorticity, and of vorticity to theta.
double coupling(const ActiveFluid& fluid, double k, double c) {
  const double aligned = 2.0 * fluid.order + fluid.flow_alignment * c;
  const double elastic = fluid.elastic_stress ? fluid.elastic_constant * k * k * aligned : 0.0;
  return aligned / 2.0 * k * k * (fluid.activity * c - elastic) / fluid.density;
}

/// The angle at which a wave grows fastest: where the coupling, quadratic in the cosine, is largest.
double best_cosine(const ActiveFluid& fluid, double k) {
  const double at_bend = coupling(fluid, k, 1.0);
  const double at_splay = coupling(fluid, k, -1.0);
  const double between = coupling(fluid, k, 0.0);
  const double curvature = (at_bend + at_splay) / 2.0 - between;
  double best = at_bend >= at_splay ? 1.0 : -1.0;
  if (curvature < 0.0) {
    const double vertex = std::clamp(-(at_bend - at_splay) / (4.0 * curvature), -1.0, 1.0);
    if (coupling(fluid, k, vertex) > coupling(fluid, k, best)) best = vertex;
  }
  return best;
}

double drag(const ActiveFluid& fluid, double k) { return (fluid.viscosity * k * k + fluid.friction) / fluid.density; }

double relaxation(const ActiveFluid& fluid, double k) {
  return fluid.rotational_diffusivity * fluid.elastic_constant * k * k;
}

}  // namespace

std::optional<ActiveFluid> active_fluid(const Constants& constants) {
  const auto find = [&](const char* name, double& value) {
    const auto at = constants.find(name);
    if (at != constants.end()) value = at->second;
    return at != constants.end();
  };
  ActiveFluid fluid;
  double a = 0.0;
  double c = 0.0;
  double elastic_stress = 0.0;
  if (!find("density", fluid.density) || !find("viscosity", fluid.viscosity) || !find("activity", fluid.activity) ||
      !find("elastic_constant", fluid.elastic_constant) ||
      !find("rotational_diffusivity", fluid.rotational_diffusivity) || !find("flow_alignment", fluid.flow_alignment) ||
      !find("bulk_A", a) || !find("bulk_C", c))
    return std::nullopt;
  find("friction", fluid.friction);
  fluid.elastic_stress = find("elastic_stress", elastic_stress) && elastic_stress > 0.0;
  if (!(a < 0.0) || !(c > 0.0)) return std::nullopt;
  fluid.order = std::sqrt(-a / (2.0 * c));
  return fluid;
}

std::optional<double> uniform_director(const Scene& scene) {
  const auto angle = scene.constants.find("initial_director_angle");
  return angle == scene.constants.end() ? std::nullopt : std::optional(angle->second);
}

double growth_rate(const ActiveFluid& fluid, double wave_number, double cosine) {
  const double of_director = -relaxation(fluid, wave_number);
  const double of_flow = -drag(fluid, wave_number);
  const double product = coupling(fluid, wave_number, cosine);
  const double mean = (of_director + of_flow) / 2.0;
  const double square = mean * mean - (of_director * of_flow - product);
  if (square < 0.0) return mean;  // a wave that oscillates as it decays
  // The sum of the eigenvalues is below 0: the larger one by the product of both, so that nothing cancels.
  const double smaller = mean - std::sqrt(square);
  return smaller == 0.0 ? 0.0 : (of_director * of_flow - product) / smaller;
}

Wave fastest_wave(const ActiveFluid& fluid, const std::array<double, 3>& box, std::optional<double> director) {
  Wave best;
  best.growth_rate = -HUGE_VAL;
  for (int y = 0; y <= most_waves; ++y) {
    for (int x = y == 0 ? 1 : -most_waves; x <= most_waves; ++x) {
      const double k = 2.0 * std::numbers::pi * std::hypot(x / box[0], y / box[1]);
      const double c =
          director ? std::cos(2.0 * (std::atan2(y / box[1], x / box[0]) - *director)) : best_cosine(fluid, k);
      const double rate = growth_rate(fluid, k, c);
      if (!(rate > best.growth_rate)) continue;
      const double stokes = coupling(fluid, k, c) / drag(fluid, k) - relaxation(fluid, k);
      best = {rate, 2.0 * std::numbers::pi / k, {x, y}, c, stokes};
    }
  }
  return best;
}

}  // namespace mesogen::nematics
