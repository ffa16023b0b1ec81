// Weakly compressible SPH as Saghatchi, Kolukisa and Yildiz publish it, to compare with and to study its failures:
// density filter, radial viscosity (its fourth kernel moment is 1.893 where 2 is needed: quintic, h = 4/3 dx, so that
// the fluid is 5 % too thin at every resolution), and a shift that scales with the spread of velocities. Its time
// scheme and its Laplacian are keys of the framework: time.scheme = "half_steps", kernel.laplacian = "plain".

#include <string>

#include "equations.hpp"
#include "fluid.hpp"
#include "mesogen/diagnostics/error.hpp"
#include "mesogen/nematics/viscous_stress.hpp"
#include "mesogen/plugin/physics.hpp"
#include "mesogen/plugin/plugin.hpp"
#include "published_passes.hpp"
#include "sums.hpp"

namespace {

using namespace mesogen;
using wcsph::PressureForm;

template <class Real, int Dim>
class WcsphPublished final : public Physics {
 public:
  void parameters(ParameterList& list) override {
    fluid_.parameters(list);
    list.text("viscosity_form", viscosity_form_)
        .choices({"component", "monaghan_gingold"})
        .doc(
            "component: Laplacian of each velocity component; monaghan_gingold: the published radial form, whose "
            "viscosity is 5 % too low on a lattice");
    list.text("pressure_form", pressure_form_)
        .choices({"corrected", "difference", "conservative"})
        .doc("as in wcsph; the published scheme has corrected");
    list.number("density_diffusion", diffusion_)
        .unit("1")
        .at_least(0)
        .at_most(0.5)
        .doc("strength delta of the density diffusion delta h c0 lap rho (delta-SPH); 0: none, as published");
    list.number("density_filter", filter_)
        .unit("1")
        .at_least(0)
        .at_most(1)
        .doc(
            "strength beta of the Shepard filter of the density from which the pressure is computed; 0: none. What the "
            "filter hides from the pressure grows");
    list.flag("filter_feedback", feedback_)
        .doc(
            "true: put the filtered density back into the density. This hides the drift of volumes; for the study of "
            "failures");
    list.number("shift", shift_)
        .unit("1")
        .at_least(0)
        .at_most(10)
        .doc("strength of the artificial particle displacement that keeps particles evenly spread; 0: none");
    list.text("shift_speed", shift_speed_)
        .choices({"spread", "strain"})
        .doc(
            "speed to which the shift is proportional. spread: spread of the neighbours' velocities, as published; "
            "strain: h |grad u|");
    list.text("motion", motion_)
        .choices({"lagrangian", "eulerian"})
        .doc("as in wcsph; the published scheme has lagrangian");
  }

  void publish(Scene& scene) const override { fluid_.publish(scene); }

  void declare(const Scene& scene, PassList& list) override {
    if (feedback_ && filter_ == 0.0)
      throw BadParameter("filter_feedback",
                         "needs a filter: set density_filter above 0, such as density_filter = 1.0, or leave "
                         "filter_feedback out");
    const bool fixed = motion_ == "eulerian";
    const bool filters = filter_ > 0.0;
    const bool radial = viscosity_form_ == "monaghan_gingold";
    const PressureForm form = wcsph::pressure_form(pressure_form_);
    fluid_.declare(scene, list, radial, false);
    wcsph::declare_fields(list, fluid_, filters);
    list.flows({"velocity", "shift_velocity", fixed});
    wcsph::declare_continuity<Real, Dim>(list, fluid_);
    if (filters) wcsph::add_density_filter<Real, Dim>(list, filter_);
    if (diffusion_ > 0.0) wcsph::add_density_diffusion<Real, Dim>(list, fluid_, diffusion_);
    if (shift_ > 0.0 && !fixed)
      shift_speed_ == "spread" ? wcsph::add_shift<Real, Dim, true>(list, shift_)
                               : wcsph::add_shift<Real, Dim, false>(list, shift_);
    const char* const compression = filters ? "compression_filtered" : "compression_midpoint";
    wcsph::declare_equation_of_state<Real>(list, fluid_, compression, form != PressureForm::difference);
    radial ? wcsph::add_momentum<Real, Dim, true>(list, fluid_, form)
           : wcsph::add_momentum<Real, Dim, false>(list, fluid_, form);
    wcsph::declare_internal_energy<Real>(list, fluid_);
    nematics::declare_viscous_stress<Real, Dim>(list, fluid_.viscosity());
    if (feedback_) wcsph::add_filter_feedback<Real>(list);
    wcsph::declare_faster_sound<Real>(list, fluid_);
  }

 private:
  wcsph::Fluid fluid_;
  std::string viscosity_form_ = "monaghan_gingold";
  std::string pressure_form_ = "corrected";
  double diffusion_ = 0.0;
  double filter_ = 1.0;
  bool feedback_ = false;
  double shift_ = 1.0;
  std::string shift_speed_ = "spread";
  std::string motion_ = "lagrangian";
};

}  // namespace

MESOGEN_PHYSICS_PLUGIN(WcsphPublished, "wcsph_published", "1.0.0",
                       "Weakly compressible flow as published: density filter, radial viscosity, shift by spread")
