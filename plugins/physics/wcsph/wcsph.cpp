// Weakly compressible SPH: rho Du/Dt = -grad p + mu lap u + forces of others, d rho/dt = -rho div u, p from rho by
// Tait. Viscosity component by component; density diffusion (delta-SPH); a shift that scales with the velocity
// gradient. The scheme of Saghatchi, Kolukisa and Yildiz, which this one comes from, is wcsph_published.

#include <optional>
#include <string>

#include "equations.hpp"
#include "fluid.hpp"
#include "mesogen/nematics/viscous_stress.hpp"
#include "mesogen/plugin/physics.hpp"
#include "mesogen/plugin/plugin.hpp"
#include "sums.hpp"

namespace {

using namespace mesogen;
using wcsph::PressureForm;

template <class Real, int Dim>
class Wcsph final : public Physics {
 public:
  void parameters(ParameterList& list) override {
    fluid_.parameters(list);
    list.text("pressure_form", pressure_form_)
        .choices({"corrected", "difference", "conservative"})
        .doc(
            "corrected: sum of both particles' pressures with the corrected gradient, which evens particles out; "
            "difference: exact for linear pressures, so that a uniform pressure moves nothing, but short kernels fail "
            "earlier; conservative: opposite forces on two particles, so they add no momentum");
    list.number_or("density_diffusion", diffusion_, "auto")
        .unit("1")
        .at_least(0)
        .at_most(0.5)
        .doc(
            "strength delta of the density diffusion delta h c0 lap rho (delta-SPH), which is h c0 / nu times as "
            "strong where that is below 1; auto: 0.1; 0.02 with inertia = "
            "false. Where pressure balances a force, the diffusion makes the flow diverge in proportion to delta. 0: "
            "none; a density that alternates from particle to particle then drives a flow where there should be none");
    list.number("shift", shift_)
        .unit("1")
        .at_least(0)
        .at_most(10)
        .doc(
            "strength of the artificial particle displacement that keeps particles evenly spread; at most a fifth of a "
            "spacing in a step. 0: none");
    list.text("motion", motion_)
        .choices({"lagrangian", "eulerian"})
        .doc(
            "lagrangian: particles move with the flow; eulerian: particles stay, and fields change by -u . grad f, so "
            "neighbours are found only once and no shift is needed");
    for (const char* const key : {"density_filter", "filter_feedback", "viscosity_form", "shift_speed"})
      list.moved(key, "belongs to the published scheme: write type = \"wcsph_published\"");
  }

  void publish(Scene& scene) const override { fluid_.publish(scene); }

  void declare(const Scene& scene, PassList& list) override {
    const bool fixed = motion_ == "eulerian";
    const PressureForm form = wcsph::pressure_form(pressure_form_);
    const bool shifts = shift_ > 0.0 && !fixed;
    const double usual = fluid_.inertia() ? 0.1 : 0.02;
    delta_ = diffusion_.value_or(usual);
    fluid_.declare(scene, list, false, form == PressureForm::corrected && delta_ == usual && shift_ == 0.3 && !fixed);
    wcsph::declare_fields(list, fluid_, false);
    list.flows({"velocity", "shift_velocity", fixed});
    wcsph::declare_continuity<Real, Dim>(list, fluid_);
    // What most scenes have shares one loop over the pairs.
    const bool together = shifts && form == PressureForm::corrected && delta_ > 0.0;
    if (delta_ > 0.0 && !together) wcsph::add_density_diffusion<Real, Dim>(list, fluid_, delta_);
    if (shifts && !together) wcsph::add_shift<Real, Dim, false>(list, shift_);
    wcsph::declare_equation_of_state<Real>(list, fluid_, "compression_midpoint", form != PressureForm::difference);
    Pass& forces = together ? all_together(list) : wcsph::add_momentum<Real, Dim, false>(list, fluid_, form);
    forces.conserves_momentum();
    wcsph::declare_internal_energy<Real>(list, fluid_);
    nematics::declare_viscous_stress<Real, Dim>(list, fluid_.viscosity());
    wcsph::declare_faster_sound<Real>(list, fluid_);
  }

 private:
  Pass& all_together(PassList& list) {
    Pass& pass = list.pass("pressure, shift and density diffusion");
    wcsph::declare_shift<false>(pass);
    wcsph::declare_diffusion(pass);
    wcsph::declare_momentum<false, PressureForm::corrected>(pass).run([this](const PassContext& context) {
      using Shift = wcsph::Shift<Real, Dim, false>;
      using Momentum = wcsph::Momentum<Real, Dim, false, PressureForm::corrected>;
      using Diffusion = wcsph::DensityDiffusion<Real>;
      sph::pair_sum(context.space(), context.neighbours<Real, Dim>(), context.kernel(),
                    sph::FusedPass<Shift, wcsph::MomentumAndDiffusion<Momentum, Diffusion>>{
                        wcsph::shift_sums<Real, Dim, false>(context, shift_),
                        {wcsph::momentum_sums<Real, Dim, false, PressureForm::corrected>(context, fluid_),
                         wcsph::diffusion_sums<Real>(context, fluid_.density_diffusivity(delta_))}});
    });
    return pass;
  }

  wcsph::Fluid fluid_;
  std::string pressure_form_ = "corrected";
  std::optional<double> diffusion_;
  double delta_ = 0.0;  // of the density diffusion
  double shift_ = 0.3;
  std::string motion_ = "lagrangian";
};

}  // namespace

MESOGEN_PHYSICS_PLUGIN(Wcsph, "wcsph", "1.0.0",
                       "Weakly compressible flow: Tait pressure, viscosity, density diffusion, particle shifting")
