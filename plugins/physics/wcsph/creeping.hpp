#pragma once

// Creeping flow: forces balance at every moment, and the fluid's mass plays no part. An explicit step is bound by the
// mass all the same, through viscosity: so the momentum equation gets another density, as large as possible.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesogen/plugin/physics.hpp"

namespace mesogen::wcsph {

/// Square of the smallest wave number that a flow in this box has, 1/m2: half a wave between walls, a whole one in a
/// periodic box.
inline double smallest_square(const Scene& scene) {
  double between_walls = 0.0;
  double longest = 0.0;
  if (scene.solids) between_walls = std::pow(std::numbers::pi / scene.widest, 2);
  for (std::size_t d = 0; d < static_cast<std::size_t>(scene.dimension); ++d) {
    if (!scene.periodic[d]) between_walls += std::pow(std::numbers::pi / scene.box[d], 2);
    longest = std::max(longest, scene.box[d]);
  }
  return between_walls > 0.0 ? between_walls : std::pow(2.0 * std::numbers::pi / longest, 2);
}

/// The largest density, kg/m3, for which the momentum of every wave relaxes at least `ratio` times faster than what
/// drives the wave changes; infinite if the scene tells nothing that changes. The rates of a wave of wave number k:
///
///     momentum, by viscosity and friction    (mu k^2 + xi) / rho
///     director, by active flow               |zeta| X k^2 / (2 (mu k^2 + xi)),   X = 2 q + |lambda|
///     director, by elasticity                K k^2 (Gamma + X^2 / (2 mu)), the second term only with elastic stress
///     anything, by an imposed speed U        U / L, L the shortest edge
///
/// Where the director relaxes or grows at the rate s, the flow lags by s rho / (mu k^2 + xi) of itself. The bulk's
/// relaxation is not among them: it changes the order of the whole scene at the start alone, and in cores it is as fast
/// as elasticity is there.
inline double creeping_density(const Scene& scene, double viscosity, double ratio) {
  const auto constant = [&](const char* name) { return scene.constant(name); };
  const double friction = scene.varying.contains("friction") ? 0.0 : constant("friction");  // where it is least
  const double a = constant("bulk_A");
  const double c = constant("bulk_C");
  const double order = a < 0.0 && c > 0.0 ? std::sqrt(-a / (2.0 * c)) : 1.0;
  const double coupling = 2.0 * order + std::abs(constant("flow_alignment"));
  const double by_flow = constant("elastic_stress") > 0.0 ? coupling * coupling / (2.0 * viscosity) : 0.0;
  const double elasticity = constant("elastic_constant") * (constant("rotational_diffusivity") + by_flow);
  const double activity = std::abs(constant("activity")) * coupling / 2.0;
  const double longest = smallest_square(scene);
  const double shortest_edge = *std::min_element(scene.box.begin(), scene.box.begin() + scene.dimension);

  double density = std::numeric_limits<double>::infinity();
  // (mu k^2 + xi)^2 / k^2 is smallest where viscosity equals friction.
  const double slowest = std::max(longest, friction / viscosity);
  if (activity > 0.0) density = std::min(density, std::pow(viscosity * slowest + friction, 2) / (activity * slowest));
  if (elasticity > 0.0) density = std::min(density, viscosity / elasticity);
  if (scene.scales.speed > 0.0)
    density = std::min(density, (viscosity * longest + friction) * shortest_edge / scene.scales.speed);
  return density / ratio;
}

}  // namespace mesogen::wcsph
