#pragma once

#include <array>
#include <optional>

#include "mesogen/plugin/scene.hpp"

namespace mesogen::nematics {

/// A uniform active nematic at rest, in which small waves grow or decay.
struct ActiveFluid {
  double density = 0.0;                 ///< rho, kg/m3
  double viscosity = 0.0;               ///< mu, Pa s
  double friction = 0.0;                ///< xi, kg/(m3 s)
  double activity = 0.0;                ///< zeta, Pa
  double elastic_constant = 0.0;        ///< K, N
  double rotational_diffusivity = 0.0;  ///< Gamma, 1/(Pa s)
  double flow_alignment = 0.0;          ///< lambda
  double order = 1.0;                   ///< q
  bool elastic_stress = false;          ///< true if the nematic's elasticity acts on the flow
};

/// Returns the active fluid that the plugins of a scene publish. Returns none if flow, nematic or activity is missing,
/// or if the nematic's equilibrium has no order.
std::optional<ActiveFluid> active_fluid(const Constants& constants);

/// Returns the rate at which a wave grows, 1/s; below 0 it decays. Let phi be the angle between the wave vector k and
/// the director, and c = cos 2 phi (1: bend, -1: splay). The small angle theta and the vorticity w of the wave obey
///
///     theta' = w/2 (1 + lambda c / (2 q)) - Gamma K k^2 theta
///     rho w' = -(mu k^2 + xi) w + 2 q k^2 (zeta c - K k^2 (2 q + lambda c)) theta
///
/// where the term with K in the second line exists only with elastic stress. The rate is the larger real part of the
/// two eigenvalues. `wave_number`: k, 1/m. `cosine`: c.
double growth_rate(const ActiveFluid& fluid, double wave_number, double cosine);

/// Returns the angle to the x axis, rad, of a director that is uniform at the start except for small disturbances: the
/// constant initial_director_angle. None if the scene has no such constant.
std::optional<double> uniform_director(const Scene& scene);

struct Wave {
  double growth_rate = 0.0;      ///< 1/s
  double length = 0.0;           ///< m
  std::array<int, 2> mode{};     ///< number of waves along each edge of the box
  double cosine = 0.0;           ///< cosine of twice the angle to the director at which it grows fastest
  double without_inertia = 0.0;  ///< growth rate if the fluid had no mass, 1/s
};

/// Returns the wave that grows fastest, or decays slowest, among the waves that fit a periodic box. `director`: its
/// angle to the x axis, rad; if none, each wave is taken at the angle that is best for it.
Wave fastest_wave(const ActiveFluid& fluid, const std::array<double, 3>& box, std::optional<double> director = {});

}  // namespace mesogen::nematics
