#pragma once

// Sums over neighbours: what each reads and writes, and how it is filled for a pass.

#include <algorithm>
#include <limits>
#include <string>

#include "fluid.hpp"
#include "mesogen/diagnostics/error.hpp"
#include "mesogen/plugin/context.hpp"
#include "mesogen/plugin/passes.hpp"
#include "passes.hpp"

namespace mesogen::wcsph {

inline PressureForm pressure_form(const std::string& word) {
  if (word == "difference") return PressureForm::difference;
  return word == "conservative" ? PressureForm::conservative : PressureForm::corrected;
}

template <PressureForm Form>
constexpr const char* summed_pressure = Form == PressureForm::difference ? "pressure" : "pressure_term";

inline Pass& declare_diffusion(Pass& pass) {
  return pass.reads_neighbours({"compression_midpoint", "volume"}).accumulates({"compression_rate"});
}

template <class Real>
DensityDiffusion<Real> diffusion_sums(const PassContext& context, double diffusivity) {
  // A stabilised step may be longer than this diffusion takes: as much as there may be does as well.
  const Scene& scene = context.scene();
  if (scene.stabilised_steps && context.step_size() > 0.0)
    diffusivity = std::min(diffusivity, scene.diffusion_step / context.step_size());
  return {context.read<Real>("volume"), context.read<Real>("compression_midpoint"),
          context.write<Real>("compression_rate"), Real(diffusivity)};
}

/// In one step. The published shift has no limit.
inline constexpr double largest_shift_in_spacings = 0.2;

template <bool BySpread>
Pass& declare_shift(Pass& pass) {
  pass.accumulates({"shift_velocity"});
  if (BySpread) return pass.reads_neighbours({"velocity"});
  // Of neighbours it needs their places alone, which come with any field that is read there.
  return pass.reads({"velocity_gradient"}).reads_neighbours({"volume"});
}

template <class Real, int Dim, bool BySpread>
Shift<Real, Dim, BySpread> shift_sums(const PassContext& context, double strength) {
  Shift<Real, Dim, BySpread> sums{};
  if constexpr (BySpread) {
    sums.velocity = context.read<Real>("velocity");
  } else {
    sums.velocity_gradient = context.read<Real>("velocity_gradient");
  }
  sums.shift = context.write<Real>("shift_velocity");
  sums.strength = Real(strength);
  sums.smoothing_length = Real(context.scene().smoothing_length);
  sums.fastest = std::numeric_limits<Real>::infinity();
  if constexpr (!BySpread)
    sums.fastest = Real(largest_shift_in_spacings * context.scene().spacing / context.step_size());
  return sums;
}

template <bool Radial, PressureForm Form>
Pass& declare_momentum(Pass& pass) {
  pass.reads({"density", "correction"})
      .reads_neighbours({summed_pressure<Form>, "volume"})
      .accumulates({"acceleration"});
  return Radial ? pass.reads_neighbours({"velocity"}) : pass;
}

template <class Real, int Dim, bool Radial, PressureForm Form>
Momentum<Real, Dim, Radial, Form> momentum_sums(const PassContext& context, const Fluid& fluid) {
  Momentum<Real, Dim, Radial, Form> sums{};
  sums.volume = context.read<Real>("volume");
  sums.pressure = context.read<Real>(summed_pressure<Form>);
  sums.density = context.read<Real>("density");
  sums.correction = context.read<Real>("correction");
  if constexpr (Radial) sums.velocity = context.read<Real>("velocity");
  sums.acceleration = context.write<Real>("acceleration");
  sums.viscosity = Real(fluid.viscosity());
  sums.mass = Real(fluid.mass());
  return sums;
}

template <class Real, int Dim>
void add_density_diffusion(PassList& list, const Fluid& fluid, double delta) {
  declare_diffusion(list.pass("density diffusion")).run([&fluid, delta](const PassContext& context) {
    sph::pair_sum(context.space(), context.neighbours<Real, Dim>(), context.kernel(),
                  diffusion_sums<Real>(context, fluid.density_diffusivity(delta)));
  });
}

template <class Real, int Dim, bool BySpread>
void add_shift(PassList& list, double strength) {
  declare_shift<BySpread>(list.pass("shift")).run([strength](const PassContext& context) {
    sph::pair_sum(context.space(), context.neighbours<Real, Dim>(), context.kernel(),
                  shift_sums<Real, Dim, BySpread>(context, strength));
  });
}

template <class Real, int Dim, bool Radial, PressureForm Form>
Pass& add_momentum_of_form(PassList& list, const Fluid& fluid) {
  return declare_momentum<Radial, Form>(list.pass(Radial ? "pressure and viscosity" : "pressure"))
      .run([&fluid](const PassContext& context) {
        sph::pair_sum(context.space(), context.neighbours<Real, Dim>(), context.kernel(),
                      momentum_sums<Real, Dim, Radial, Form>(context, fluid));
      });
}

template <class Real, int Dim, bool Radial>
Pass& add_momentum(PassList& list, const Fluid& fluid, PressureForm form) {
  switch (form) {
    case PressureForm::difference:
      return add_momentum_of_form<Real, Dim, Radial, PressureForm::difference>(list, fluid);
    case PressureForm::conservative:
      return add_momentum_of_form<Real, Dim, Radial, PressureForm::conservative>(list, fluid);
    default: return add_momentum_of_form<Real, Dim, Radial, PressureForm::corrected>(list, fluid);
  }
}

}  // namespace mesogen::wcsph
