#pragma once

// The sums of weakly compressible SPH. Density is kept as compression c = rho / rho0 - 1, so that float resolves it
// however small it is.

#include "mesogen/exec/for_each.hpp"
#include "mesogen/sph/pair_sum.hpp"

namespace mesogen::wcsph {

/// Continuity: dc/dt = -(1 + c) div u, with the corrected gradient; c at the midpoint of the step is c + ahead dc/dt.
template <class Real, int Dim>
struct Continuity {
  FieldView<const Real> compression, velocity_gradient;
  FieldView<Real> rate, midpoint, density;
  Real ahead;  // s
  Real reference_density;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    Real divergence = Real(0);
    for (int d = 0; d < Dim; ++d) divergence += velocity_gradient(d * Dim + d, i);
    const Real change = -(Real(1) + compression(i)) * divergence;
    rate(i) += change;
    midpoint(i) = compression(i) + ahead * change;
    density(i) = reference_density * (Real(1) + midpoint(i));
  }
};

/// Density diffusion (delta-SPH; Molteni and Colagrossi 2009): dc/dt gains D lap c, D of Fluid::density_diffusivity,
/// with
///   lap c = 2 sum_j V_j (c_i - c_j) W'_ij / r_ij,
/// which keeps sum_i V_i c_i. Density that alternates from particle to particle has next to no gradient: pressure does
/// not even it out.
template <class Real>
struct DensityDiffusion {
  static constexpr int sum_count = 1;

  FieldView<const Real> volume, compression;
  FieldView<Real> rate;
  Real diffusivity;

  using Own = Real;
  MESOGEN_HOST_DEVICE Own load(Index i) const { return compression(i); }

  template <class Pair, class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void pair(const Own& own, const Pair& p, Lane* sum) const {
    add(own, p, p.load(volume) * p.gradient(), sum);
  }
  /// `weight`: V_j W'_ij / r_ij.
  template <class Pair, class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void add(const Own& own, const Pair& p, const Lane& weight,
                                                      Lane* sum) const {
    sum[0] = sum[0] + weight * (Lane(own) - p.load(compression));
  }

  MESOGEN_HOST_DEVICE void finish(Index i, const Own&, const Real* sum) const {
    rate(i) += Real(2) * diffusivity * sum[0];
  }
};

/// Particle shifting (artificial particle displacement; Shadloo et al. 2011, Ozbulut et al. 2017), as a velocity:
///   sum_j r_ij / r_ij^3 r0^2 s,   r0 = mean distance of neighbours,
/// where the speed s is h |grad u|, or as published (`BySpread`) |sum_j (u_i - u_j) W_ij| / sum_j W_ij: particles are
/// drawn out most along the lines toward stagnation points, and there the published one vanishes. A limit keeps one
/// particle on top of another from being thrown out of the box.
template <class Real, int Dim, bool BySpread>
struct Shift {
  static constexpr int sum_count = 2 + Dim + (BySpread ? 1 + Dim : 0);
  enum Sum { neighbours, distances, push, weight = push + Dim, weighted_velocity };

  FieldView<const Real> velocity;           // empty unless BySpread
  FieldView<const Real> velocity_gradient;  // empty with BySpread
  FieldView<Real> shift;
  Real strength;
  Real smoothing_length;  // distances are taken in it: 1 / r^3 of the particle itself must not overflow
  Real fastest;           // largest shift, m/s

  struct Own {
    Real velocity[Dim];
  };
  MESOGEN_HOST_DEVICE Own load(Index i) const {
    Own own{};
    if constexpr (BySpread)
      for (int d = 0; d < Dim; ++d) own.velocity[d] = velocity(d, i);
    return own;
  }

  template <class Pair, class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void pair([[maybe_unused]] const Own& own, const Pair& p,
                                                       Lane* sum) const {
    const Lane inverse = p.inside(p.inverse_distance * smoothing_length);
    sum[neighbours] = p.add_inside(Lane(Real(1)), sum[neighbours]);
    sum[distances] = p.add_inside(p.distance, sum[distances]);
    const Lane cube = inverse * inverse * inverse;
    exec::unroll<Dim>([&](auto d) { sum[push + d] = sum[push + d] + cube * p.separation[d]; });
    if constexpr (BySpread) {
      const Lane w = p.value();
      sum[weight] = sum[weight] + w;
      exec::unroll<Dim>([&](auto d) {
        sum[weighted_velocity + d] = sum[weighted_velocity + d] + w * (Lane(own.velocity[d]) - p.load(velocity, d));
      });
    }
  }

  MESOGEN_HOST_DEVICE void finish(Index i, const Own&, const Real* sum) const {
    Real square = Real(0);
    Real speed;  // in smoothing lengths, 1/s
    if constexpr (BySpread) {
      for (int d = 0; d < Dim; ++d) square += sum[weighted_velocity + d] * sum[weighted_velocity + d];
      speed = exec::square_root(square) / (sum[weight] * smoothing_length);
    } else {
      for (int c = 0; c < Dim * Dim; ++c) square += velocity_gradient(c, i) * velocity_gradient(c, i);
      speed = exec::square_root(square);
    }
    // The particle itself was counted, at distance zero.
    const Real others = sum[neighbours] - Real(1);
    const Real relative = others > Real(0) ? sum[distances] / (others * smoothing_length) : Real(0);
    Real scale = strength * relative * relative * speed;
    Real pushed = Real(0);
    for (int d = 0; d < Dim; ++d) pushed += sum[push + d] * sum[push + d];
    pushed = exec::square_root(pushed);
    if (scale * pushed > fastest) scale = fastest / pushed;
    for (int d = 0; d < Dim; ++d) shift(d, i) += scale * sum[push + d];
  }
};

/// Tait: ((1 + c)^7 - 1) / 7, the pressure over rho0 c0^2, expanded so that nothing cancels.
template <class Real>
MESOGEN_HOST_DEVICE Real tait(Real c) {
  return c * (Real(1) + c * (Real(3) + c * (Real(5) + c * (Real(5) + c * (Real(3) + c * (Real(1) + c / Real(7)))))));
}

/// The pressure; and p / rho^2 where somebody sums that.
template <class Real>
struct EquationOfState {
  FieldView<const Real> compression;
  FieldView<Real> pressure;
  FieldView<Real> over_density_squared;  // may be empty
  Real stiffness;                        // rho0 c0^2
  Real reference_density;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    const Real c = compression(i);
    pressure(i) = stiffness * tait(c);
    if (!over_density_squared) return;
    const Real rho = reference_density * (Real(1) + c);
    over_density_squared(i) = pressure(i) / (rho * rho);
  }
};

/// Makes the compression that a step leaves smaller, for a sound that is faster from then on, so that the pressure
/// stays as it is: tait(c') = softening tait(c).
template <class Real>
struct SoftenCompression {
  FieldView<const Real> compression;
  FieldView<Real> rate;
  double softening;
  double step_size;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    const double left = static_cast<double>(compression(i)) + step_size * static_cast<double>(rate(i));
    const double wanted = softening * tait(left);
    double soft = softening * left;
    for (int n = 0; n < 4; ++n) {  // Newton's method: tait'(c) = (1 + c)^6
      const double cube = (1.0 + soft) * (1.0 + soft) * (1.0 + soft);
      soft -= (tait(soft) - wanted) / (cube * cube);
    }
    rate(i) += static_cast<Real>((soft - left) / step_size);
  }
};

/// Energy that compression stores, per volume at rest: rho0 e with de = p / rho^2 drho and e(rho0) = 0, so
///   rho0 c0^2 / 7 (((1 + c)^6 - 1) / 6 + 1 / (1 + c) - 1), expanded so that nothing cancels.
template <class Real>
struct InternalEnergy {
  FieldView<const Real> compression;
  FieldView<Real> energy;
  Real stiffness;  // rho0 c0^2

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    const Real c = compression(i);
    const Real series =
        Real(5) / Real(2) + c * (Real(10) / Real(3) + c * (Real(5) / Real(2) + c * (Real(1) + c / Real(6))));
    energy(i) = stiffness / Real(7) * c * c * (series + Real(1) / (Real(1) + c));
  }
};

/// How the pressure's force is summed; B is the correction of the gradient.
enum class PressureForm {
  corrected,    ///< -rho_i sum_j V_j (p_i / rho_i^2 + p_j / rho_j^2) B_i grad W_ij: also evens particles out
  difference,   ///< -1 / rho_i sum_j V_j (p_j - p_i) B_i grad W_ij: exact for linear p, so a uniform p moves nothing
  conservative  ///< -sum_j m (p_i / rho_i^2 + p_j / rho_j^2) grad W_ij: opposite forces on two particles
};

/// Acceleration by pressure; with `Radial` also by viscosity in the form of Monaghan & Gingold (1983),
/// 8 mu/rho sum_j V_j (u_ij . r_ij) / r_ij^2 B_i grad W_ij. (Otherwise viscosity is declared as a diffusion.)
template <class Real, int Dim, bool Radial, PressureForm Form>
struct Momentum {
  static constexpr int sum_count = Radial ? 2 * Dim : Dim;
  FieldView<const Real> pressure;  // p / rho^2 where that is summed
  FieldView<const Real> volume, density, correction;
  FieldView<const Real> velocity;  // empty unless Radial
  FieldView<Real> acceleration;
  Real viscosity;
  Real mass;  // of a particle

  struct Own {
    Real pressure;
    Real velocity[Dim];
  };
  MESOGEN_HOST_DEVICE Own load(Index i) const {
    Own own{pressure(i), {}};
    if constexpr (Radial)
      for (int d = 0; d < Dim; ++d) own.velocity[d] = velocity(d, i);
    return own;
  }

  template <class Pair, class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void pair(const Own& own, const Pair& p, Lane* sum) const {
    const Lane slope = p.gradient();
    add(own, p, slope, p.load(volume) * slope, sum);
  }
  /// `slope`: W'_ij / r_ij; `g`: V_j times it.
  template <class Pair, class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void add(const Own& own, const Pair& p, const Lane& slope, const Lane& g,
                                                      Lane* sum) const {
    const Lane other = p.load(pressure);
    const Lane weight = Form == PressureForm::conservative ? slope : g;
    const Lane push =
        weight * (Form == PressureForm::difference ? other - Lane(own.pressure) : other + Lane(own.pressure));
    exec::unroll<Dim>([&](auto d) { sum[d] = sum[d] + push * p.separation[d]; });
    if constexpr (Radial) {
      Lane approach(Real(0));
      exec::unroll<Dim>(
          [&](auto d) { approach = approach + (Lane(own.velocity[d]) - p.load(velocity, d)) * p.separation[d]; });
      const Lane drag = g * approach * p.inverse_distance * p.inverse_distance;
      exec::unroll<Dim>([&](auto d) { sum[Dim + d] = sum[Dim + d] + drag * p.separation[d]; });
    }
  }

  MESOGEN_HOST_DEVICE void finish(Index i, const Own&, const Real* sum) const {
    const Real rho = density(i);
    Real corrected[Dim] = {};  // what the correction is to be applied to
    for (int d = 0; d < Dim; ++d) {
      if constexpr (Form == PressureForm::difference) corrected[d] -= sum[d] / rho;
      if constexpr (Form == PressureForm::corrected) corrected[d] -= rho * sum[d];
      if constexpr (Radial) corrected[d] += Real(8) * viscosity / rho * sum[Dim + d];
    }
    for (int a = 0; a < Dim; ++a) {
      Real total = Real(0);
      if constexpr (Radial || Form != PressureForm::conservative)
        for (int b = 0; b < Dim; ++b) total += correction(a * Dim + b, i) * corrected[b];
      if constexpr (Form == PressureForm::conservative) total -= mass * sum[a];
      acceleration(a, i) += total;
    }
  }
};

/// Both in one loop, with one weight per pair.
template <class Momentum, class Diffusion>
struct MomentumAndDiffusion {
  static constexpr int sum_count = Momentum::sum_count + Diffusion::sum_count;
  Momentum momentum;
  Diffusion diffusion;

  struct Own {
    typename Momentum::Own momentum;
    typename Diffusion::Own diffusion;
  };
  MESOGEN_HOST_DEVICE Own load(Index i) const { return {momentum.load(i), diffusion.load(i)}; }

  template <class Pair, class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void pair(const Own& own, const Pair& p, Lane* sum) const {
    const Lane slope = p.gradient();
    const Lane g = p.load(momentum.volume) * slope;
    momentum.add(own.momentum, p, slope, g, sum);
    diffusion.add(own.diffusion, p, g, sum + Momentum::sum_count);
  }

  template <class Real>
  MESOGEN_HOST_DEVICE void finish(Index i, const Own& own, const Real* sum) const {
    momentum.finish(i, own.momentum, sum);
    diffusion.finish(i, own.diffusion, sum + Momentum::sum_count);
  }
};

}  // namespace mesogen::wcsph
