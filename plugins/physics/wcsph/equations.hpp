#pragma once

// The fields of a weakly compressible flow, and the passes that both flows have: continuity, equation of state, and a
// sound that gets faster.

#include <string>

#include "fluid.hpp"
#include "mesogen/plugin/context.hpp"
#include "mesogen/plugin/passes.hpp"
#include "passes.hpp"

namespace mesogen::wcsph {

// The velocity is watched before the compression: fields are looked at in the order of their declaration.
//
// `filters`: the scheme has a density filter, which may be what broke it.
inline void declare_fields(PassList& list, Fluid& fluid, bool filters) {
  list.field("velocity", Rank::vector)
      .unit("m/s")
      .doc("u")
      .shown()
      .predicted_by("acceleration")
      .watched_by([&fluid](double fastest, double) {
        fluid.sound().flows_at(fastest);
        return std::string();
      });
  list.field("acceleration", Rank::vector).unit("m/s2").doc("Du/Dt; other plugins may add to it");
  // Far beyond what even a badly chosen sound speed gives: the fluid is no longer weakly compressible.
  list.field("compression", Rank::scalar)
      .doc("rho / rho0 - 1; a run is stopped if it is outside -0.3 to 0.3")
      .advanced_by("compression_rate")
      .watched_by([&fluid](double largest, double step_size) { return fluid.sound().after_step(largest, step_size); })
      .stays_within(
          -AdaptiveSound::broken, AdaptiveSound::broken,
          std::string("If the flow is faster than a tenth of the sound, leave sound_speed and time.step at \"auto\", "
                      "where the sound adapts, or raise sound_speed; else ") +
              (filters ? "set density_filter = 0.0, " : "") +
              "leave the shift on and time.scheme at \"midpoint\", or take a smaller step (time.factor = 0.5)");
  list.field("compression_rate", Rank::scalar).unit("1/s").doc("D(rho / rho0)/Dt");
  list.field("compression_midpoint", Rank::scalar).doc("rho / rho0 - 1 at the midpoint of the step");
  list.field("density", Rank::scalar)
      .unit("kg/m3")
      .doc("rho at the midpoint of the step; with inertia = false, about the artificial density");
  list.field("pressure", Rank::scalar).unit("Pa").doc("p at the midpoint of the step");
  list.field("internal_energy", Rank::scalar)
      .unit("J/m3")
      .doc(
          "energy stored by compression, per volume at rest: rho0 times the integral of p / rho^2 over rho. A replay "
          "computes it with the sound speed of the start");
  list.field("shift_velocity", Rank::vector).unit("m/s").doc("artificial displacement of particles per time");
}

template <class Real, int Dim>
void declare_continuity(PassList& list, const Fluid& fluid) {
  list.pass("continuity")
      .reads({"compression", "velocity_gradient"})
      .accumulates({"compression_rate"})
      .writes({"compression_midpoint", "density"})
      .run([&fluid](const PassContext& context) {
        Continuity<Real, Dim> rate{};
        rate.compression = context.read<Real>("compression");
        rate.velocity_gradient = context.read<Real>("velocity_gradient");
        rate.rate = context.write<Real>("compression_rate");
        rate.midpoint = context.write<Real>("compression_midpoint");
        rate.density = context.write<Real>("density");
        // In stabilised steps compression is kept at the midpoints of steps, and advanced by the velocity between them:
        // so sound is stable in steps of any length up to 2 mu / (rho c0^2).
        rate.ahead = Real(context.scene().stabilised_steps ? context.step_size() : context.step_size() / 2.0);
        rate.reference_density = Real(fluid.density());
        exec::for_each(context.space(), context.count(), rate);
      });
}

/// The pressure of the field `compression`; with `sums` also p / rho^2, for who sums that.
template <class Real>
void declare_equation_of_state(PassList& list, const Fluid& fluid, const std::string& compression, bool sums) {
  Pass& pass = list.pass("equation of state").reads({compression}).writes({"pressure"});
  if (sums) {
    list.field("pressure_term", Rank::scalar).unit("Pa m6/kg2").doc("p / rho^2");
    pass.writes({"pressure_term"});
  }
  pass.run([&fluid, compression, sums](const PassContext& context) {
    EquationOfState<Real> state{};
    state.compression = context.read<Real>(compression);
    state.pressure = context.write<Real>("pressure");
    if (sums) state.over_density_squared = context.write<Real>("pressure_term");
    state.stiffness = Real(fluid.stiffness());
    state.reference_density = Real(fluid.density());
    exec::for_each(context.space(), context.count(), state);
  });
}

template <class Real>
void declare_internal_energy(PassList& list, const Fluid& fluid) {
  list.pass("internal energy, for readers", Phase::observe)
      .reads({"compression"})
      .writes({"internal_energy"})
      .run([&fluid](const PassContext& context) {
        exec::for_each(context.space(), context.count(),
                       InternalEnergy<Real>{context.read<Real>("compression"), context.write<Real>("internal_energy"),
                                            Real(fluid.stiffness())});
      });
}

// Hardly ever does it do anything.
template <class Real>
void declare_faster_sound(PassList& list, Fluid& fluid) {
  list.keep("sound", AdaptiveSound::kept, [&fluid] { return fluid.sound().state(); });
  list.pass("faster sound")
      .reads({"compression"})
      .accumulates({"compression_rate"})
      .run([&fluid](const PassContext& context) {
        const double softening = fluid.sound().softening();
        if (!(softening < 1.0) || !(context.step_size() > 0.0)) return;
        exec::for_each(
            context.space(), context.count(),
            SoftenCompression<Real>{context.read<Real>("compression"), context.write<Real>("compression_rate"),
                                    softening, context.step_size()});
        fluid.sound().rise();
      });
}

}  // namespace mesogen::wcsph
