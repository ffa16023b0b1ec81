#pragma once

// The momentum equation of one mode: loops over modes call these, on the host or on a device.

#include <array>
#include <cmath>
#include <cstddef>

#include "mesogen/exec/unroll.hpp"
#include "mesogen/mesh/kept_modes.hpp"

namespace mesogen::incompressible {

using mesh::Complex;

struct Fluid {
  double density = 1.0;    ///< kg/m3
  double viscosity = 0.0;  ///< Pa s
  double friction = 0.0;   ///< force density per velocity, kg/(m3 s)
  bool inertia = true;
};

/// (1 - exp(-z)) / z, with decay = exp(-z) - 1.
MESOGEN_HOST_DEVICE inline double phi1(double z, double decay) { return z < 1e-8 ? 1.0 - z / 2.0 : -decay / z; }
/// (1 - phi1(z)) / z, with first = phi1(z).
MESOGEN_HOST_DEVICE inline double phi2(double z, double first) {
  return z < 1e-3 ? 0.5 - z / 6.0 + z * z / 24.0 : (1.0 - first) / z;
}

/// Leaves of a wave what has no divergence.
template <int Dim>
MESOGEN_HOST_DEVICE void project(const std::array<double, Dim>& k, Complex* u) {
  const double square = mesh::KeptModes<Dim>::square(k);
  Complex along(0.0);
  for (int d = 0; d < Dim; ++d) along += k[d] * u[d];
  if (square == 0.0) return;
  for (int d = 0; d < Dim; ++d) u[d] -= k[d] / square * along;
}

template <int Dim>
struct StartFlow {
  std::array<const Complex*, Dim> velocity;
  std::array<Complex*, Dim> start;
  bool inertia;

  MESOGEN_HOST_DEVICE void operator()(std::size_t n, const std::array<double, Dim>& k) const {
    Complex u[Dim];
    for (int d = 0; d < Dim; ++d) u[d] = inertia ? velocity[d][n] : Complex(0.0);
    project<Dim>(k, u);
    for (int d = 0; d < Dim; ++d) start[d][n] = u[d];
  }
};

template <int Dim>
struct TakeForce {
  std::array<const Complex*, Dim> acceleration;
  std::array<Complex*, Dim> older;
  std::array<Complex*, Dim> newer;

  MESOGEN_HOST_DEVICE void operator()(std::size_t n, const std::array<double, Dim>& k) const {
    // First, so that the values need not be kept while others are computed.
    exec::unroll<Dim>([&](auto d) { older[d][n] = newer[d][n]; });
    Complex a[Dim];
    exec::unroll<Dim>([&](auto d) { a[d] = acceleration[d][n]; });
    project<Dim>(k, a);
    exec::unroll<Dim>([&](auto d) { newer[d][n] = a[d]; });
  }
};

/// The velocity `span` after the start of the step.
template <int Dim>
struct AdvanceModes {
  Fluid fluid;
  double span;      // s
  double per_time;  // dN/dt = (newer - older) per_time
  double at_start;  // N at the start of the step = newer + (newer - older) at_start
  std::array<const Complex*, Dim> start;
  std::array<const Complex*, Dim> older;
  std::array<const Complex*, Dim> newer;
  std::array<Complex*, Dim> velocity;

  MESOGEN_HOST_DEVICE void operator()(std::size_t n, const std::array<double, Dim>& k) const {
    const double rate = (fluid.viscosity * mesh::KeptModes<Dim>::square(k) + fluid.friction) / fluid.density;
    // u = of_start u_start + constant N_start + slope dN/dt
    double of_start = 0.0;
    double constant = rate > 0.0 ? 1.0 / rate : 0.0;
    double slope = span * constant;
    if (fluid.inertia) {
      const double z = rate * span;
      const double decay = expm1(-z);
      const double first = phi1(z, decay);
      of_start = 1.0 + decay;
      constant = span * first;
      slope = span * span * phi2(z, first);
    }
    const double of_newer = constant * (1.0 + at_start) + slope * per_time;
    const double of_older = -constant * at_start - slope * per_time;
    for (int d = 0; d < Dim; ++d)
      velocity[d][n] = of_start * start[d][n] + of_newer * newer[d][n] + of_older * older[d][n];
  }
};

}  // namespace mesogen::incompressible
