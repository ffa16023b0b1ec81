// Weakly compressible SPH: rho Du/Dt = -grad p + mu lap u + forces of others, d rho/dt = -rho div u, p from rho by
// Tait. Scheme: Saghatchi, Kolukisa, Yildiz, with the viscosity component by component by default, because the radial
// form is not consistent on a lattice (its fourth kernel moment is 1.893 where 2 is needed: quintic, h = 4/3 dx), which
// makes the fluid 5 % too thin at every resolution.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "adaptive_sound.hpp"
#include "creeping.hpp"
#include "mesogen/diagnostics/error.hpp"
#include "mesogen/plugin/physics.hpp"
#include "mesogen/plugin/plugin.hpp"
#include "passes.hpp"
#include "sound_speed.hpp"
#include "without_sound.hpp"

namespace {

using namespace mesogen;
using wcsph::PressureForm;

template <class Real, int Dim>
class Wcsph final : public Physics {
 public:
  void parameters(ParameterList& list) override {
    list.number("density", physical_density_).unit("kg/m3").above(0).required().doc("rho0: reference density");
    list.number("viscosity", viscosity_).unit("Pa s").above(0).required().doc("mu: dynamic viscosity");
    list.flag("inertia", inertia_)
        .doc(
            "solve the momentum equation with the fluid's density; or creeping (Stokes) flow: with an artificial "
            "density, as large as relaxation_ratio allows. The field `density` is the artificial one then");
    list.number("relaxation_ratio", relaxation_ratio_)
        .unit("1")
        .at_least(2)
        .doc(
            "with inertia = false: momentum relaxes at least so many times faster than the nematic changes. Growth "
            "rates are too low by up to 1 / relaxation_ratio, and steps are as many times more as it is larger");
    list.text("viscosity_form", viscosity_form_)
        .choices({"component", "monaghan_gingold"})
        .doc("Laplacian of each velocity component, or the radial form, which is 5 % too thin on a lattice");
    list.number_or("sound_speed", sound_speed_, "auto")
        .unit("m/s")
        .above(0)
        .doc(
            "c0; auto: 10 times the expected speed, stresses / (rho delta), and for free as high as the viscous step "
            "allows. It rises during a run, and steps get shorter, where the largest |rho / rho0 - 1| exceeds 3 times "
            "density_variation on average over the time of sound through the box, or 10 times at any moment, or the "
            "flow exceeds half of c0. A c0 that is given, or any with a given time.step, stays");
    list.number_or("expected_speed", expected_speed_, "auto")
        .unit("m/s")
        .at_least(0)
        .doc("largest speed that the flow will reach, for c0; auto: the initial one");
    list.number("density_variation", density_variation_)
        .unit("1")
        .above(0)
        .at_most(0.1)
        .doc("delta: relative density variation that c0 is chosen for");
    list.text("pressure_form", pressure_form_)
        .choices({"corrected", "difference", "conservative"})
        .doc(
            "a sum of both particles' pressures with the corrected gradient, which evens particles out; their "
            "difference, "
            "exact for linear pressures: a uniform one moves nothing, and short kernels break earlier; or the sum with "
            "opposite forces on two particles: no momentum drift");
    list.number("density_diffusion", diffusion_)
        .unit("1")
        .at_least(0)
        .at_most(0.5)
        .doc(
            "delta of the density diffusion delta h c0 lap rho (delta-SPH); 0: none, and what alternates from particle "
            "to particle drives a flow where none should be");
    list.number("density_filter", filter_)
        .unit("1")
        .at_least(0)
        .at_most(1)
        .doc(
            "beta of the Shepard filter of the density that the pressure is made from, 1 as published; 0: none. What "
            "it hides from the pressure grows");
    list.flag("filter_feedback", feedback_)
        .doc("put the density of density_filter back into the density; hides volume drift, for the study of failures");
    list.number("shift", shift_)
        .unit("1")
        .at_least(0)
        .at_most(10)
        .doc(
            "strength of the artificial particle displacement that keeps particles evenly spread, 1 with shift_speed = "
            "\"spread\"; 0: none");
    list.text("shift_speed", shift_speed_)
        .choices({"spread", "strain"})
        .doc("speed that the shift scales with: spread of the velocities of neighbours, as published, or h |grad u|");
    list.text("motion", motion_)
        .choices({"lagrangian", "eulerian"})
        .doc(
            "particles go with the flow; or stay, and fields change by -u . grad f: neighbours are found once, and "
            "nothing needs a shift");
  }

  void scales(const Scene&, Scales& scales) const override {
    if (expected_speed_) scales.speed = std::max(scales.speed, *expected_speed_);
  }
  void constants(Constants& constants) const override {
    constants["density"] = density_ > 0.0 ? density_ : physical_density_;  // 0 before prepare()
    constants["viscosity"] = viscosity_;
    if (!inertia_) constants["physical_density"] = physical_density_;
    if (!inertia_) constants["relaxation_ratio"] = relaxation_ratio_;
    if (std::isfinite(creeping_density_)) constants["creeping_density"] = creeping_density_;
    constants["sound_speed"] = sound_.speed();
    constants["automatic_sound_speed"] = automatic_sound_speed_;
  }

  // Above what is needed the sound may be as fast, at no cost, as the acoustic limit on the step meets the viscous one.
  void prepare(const Scene& scene) override {
    choose_density(scene);
    if (feedback_ && filter_ == 0.0)
      throw Error(ExitCode::bad_case,
                  "filter_feedback needs a filter: set density_filter above 0, such as density_filter = 1.0, or leave "
                  "filter_feedback out");
    const double length = *std::min_element(scene.box.begin(), scene.box.begin() + Dim);
    const double needed = wcsph::needed_sound_speed({density_, viscosity_, density_variation_}, scene.scales, length);
    const double free = 0.25 * scene.smoothing_length / viscous_step(scene);
    automatic_sound_speed_ = std::max(needed, free);
    const double longest = *std::max_element(scene.box.begin(), scene.box.begin() + Dim);
    sound_.start(sound_speed_.value_or(automatic_sound_speed_), density_variation_, longest, !sound_speed_);
    smoothing_length_ = scene.smoothing_length;
    mass_ = density_ * std::pow(scene.spacing, Dim);
  }

  void passes(PassList& list) override {
    fields(list);
    const bool fixed = motion_ == "eulerian";
    list.flows({"velocity", "shift_velocity", fixed});
    continuity(list);
    const bool filters = filter_ > 0.0;
    if (filters) density_filter(list);
    const bool shifts = shift_ > 0.0 && !fixed;
    // What most scenes have shares one loop over the pairs.
    const bool together = shifts && shift_speed_ == "strain" && viscosity_form_ == "component" &&
                          pressure_form_ == "corrected" && diffusion_ > 0.0;
    if (diffusion_ > 0.0 && !together) density_diffusion(list);
    if (shifts && !together) shift_speed_ == "spread" ? shift<true>(list) : shift<false>(list);
    const std::string compression = filters ? "compression_filtered" : "compression_midpoint";
    equation_of_state(list, compression);
    if (together) {
      all_together(list);
    } else {
      viscosity_form_ == "component" ? momentum<false>(list) : momentum<true>(list);
    }
    list.pass("internal energy, for readers", Phase::observe)
        .reads({"compression"})
        .writes({"internal_energy"})
        .run([this](const PassContext& context) {
          exec::for_each(context.space(), context.count(),
                         wcsph::InternalEnergy<Real>{context.read<Real>("compression"),
                                                     context.write<Real>("internal_energy"), Real(stiffness())});
        });
    if (filters && feedback_) {
      list.pass("filter feedback")
          .reads({"compression_filtered", "compression_midpoint"})
          .accumulates({"compression_rate"})
          .run([](const PassContext& context) {
            const double dt = context.step_size();
            exec::for_each(context.space(), context.count(),
                           wcsph::Feedback<Real>{
                               context.read<Real>("compression_filtered"), context.read<Real>("compression_midpoint"),
                               context.write<Real>("compression_rate"), Real(dt > 0.0 ? 1.0 / dt : 0.0)});
          });
    }
    faster_sound(list);
  }

  void step_limits(const Scene& scene, StepLimits& limits) const override {
    limits.add("sound: 0.25 h / c0", sound_step(scene));
    limits.add("viscosity: stable diffusion by mu / rho", viscous_step(scene));
  }

  // With keys of its own the case asks for this plugin.
  void suggest(const Scene& scene, const StepLimits& limits, std::vector<Suggestion>& list) const override {
    if (viscosity_form_ == "component" && density_variation_ == 0.01 && pressure_form_ == "corrected" &&
        diffusion_ == 0.1 && filter_ == 0.0 && !feedback_ && shift_ == 0.3 && shift_speed_ == "strain" &&
        motion_ == "lagrangian")
      wcsph::suggest_no_sound(scene, limits, std::min(sound_step(scene), viscous_step(scene)), list);
  }

 private:
  void choose_density(const Scene& scene) {
    creeping_density_ = wcsph::creeping_density(scene, viscosity_, relaxation_ratio_);
    if (inertia_ && relaxation_ratio_ != 20.0)
      throw Error(ExitCode::bad_case, "relaxation_ratio has a meaning only with inertia = false");
    if (!inertia_ && !std::isfinite(creeping_density_))
      throw Error(ExitCode::bad_case,
                  "inertia = false needs to know how fast the scene changes, and nothing in it tells: there is no "
                  "nematic, moving wall or initial velocity. Give expected_speed, the largest speed of the flow, or "
                  "leave inertia out");
    density_ = inertia_ ? physical_density_ : creeping_density_;
  }

  [[nodiscard]] double sound_step(const Scene& scene) const { return 0.25 * scene.smoothing_length / sound_.speed(); }
  [[nodiscard]] double stiffness() const { return density_ * sound_.speed() * sound_.speed(); }
  // The radial form takes up to 3.3 times as much from the shortest waves as the Laplacian of the components.
  [[nodiscard]] double viscous_step(const Scene& scene) const {
    return scene.diffusion_step * density_ / viscosity_ / (viscosity_form_ == "component" ? 1.0 : 4.0);
  }

  // The velocity is watched before the compression: fields are looked at in the order of their declaration.
  void fields(PassList& list) {
    list.field("velocity", Rank::vector)
        .unit("m/s")
        .doc("u")
        .predicted_by("acceleration")
        .watched_by([this](double fastest, double) {
          sound_.flows_at(fastest);
          return std::string();
        });
    list.field("acceleration", Rank::vector).unit("m/s2").doc("Du/Dt; others may add to it");
    // Far beyond what even a badly chosen sound speed gives: the fluid is no longer weakly compressible.
    list.field("compression", Rank::scalar)
        .doc("rho / rho0 - 1; a run in which it leaves -0.3 to 0.3 is stopped")
        .advanced_by("compression_rate")
        .watched_by([this](double largest, double step_size) { return sound_.after_step(largest, step_size); })
        .stays_within(
            -wcsph::AdaptiveSound::broken, wcsph::AdaptiveSound::broken,
            "If the flow is faster than a tenth of the sound, leave sound_speed and time.step at \"auto\", where the "
            "sound adapts, or raise sound_speed; else leave the shift on, density_filter at 0 and time.scheme at "
            "\"midpoint\", or take a smaller step (time.factor = 0.5)");
    list.field("compression_rate", Rank::scalar).unit("1/s").doc("D(rho / rho0)/Dt");
    list.field("compression_midpoint", Rank::scalar).doc("rho / rho0 - 1 at the midpoint of the step");
    list.field("compression_filtered", Rank::scalar).doc("the same after the density filter");
    list.field("density", Rank::scalar)
        .unit("kg/m3")
        .doc("rho at the midpoint of the step; with inertia = false about the artificial one");
    list.field("pressure", Rank::scalar).unit("Pa").doc("p at the midpoint of the step");
    list.field("internal_energy", Rank::scalar)
        .unit("J/m3")
        .doc(
            "energy stored by compression, per volume at rest: rho0 times the integral of p / rho^2 over rho. A replay "
            "makes it with the sound of the start");
    list.field("shift_velocity", Rank::vector).unit("m/s").doc("artificial displacement per time");
  }

  void continuity(PassList& list) {
    list.pass("continuity")
        .reads({"compression", "velocity_gradient"})
        .accumulates({"compression_rate"})
        .writes({"compression_midpoint", "density"})
        .run([this](const PassContext& context) {
          wcsph::Continuity<Real, Dim> rate{};
          rate.compression = context.read<Real>("compression");
          rate.velocity_gradient = context.read<Real>("velocity_gradient");
          rate.rate = context.write<Real>("compression_rate");
          rate.midpoint = context.write<Real>("compression_midpoint");
          rate.density = context.write<Real>("density");
          rate.half_step = Real(context.step_size() / 2.0);
          rate.reference_density = Real(density_);
          exec::for_each(context.space(), context.count(), rate);
        });
  }

  void equation_of_state(PassList& list, const std::string& compression) {
    const bool sums = pressure_form_ != "difference";
    Pass& pass = list.pass("equation of state").reads({compression}).writes({"pressure"});
    if (sums) {
      list.field("pressure_term", Rank::scalar).unit("Pa m6/kg2").doc("p / rho^2");
      pass.writes({"pressure_term"});
    }
    pass.run([this, compression, sums](const PassContext& context) {
      wcsph::EquationOfState<Real> state{};
      state.compression = context.read<Real>(compression);
      state.pressure = context.write<Real>("pressure");
      if (sums) state.over_density_squared = context.write<Real>("pressure_term");
      state.stiffness = Real(stiffness());
      state.reference_density = Real(density_);
      exec::for_each(context.space(), context.count(), state);
    });
  }

  void density_filter(PassList& list) {
    list.pass("density filter")
        .reads_neighbours({"compression_midpoint"})
        .writes({"compression_filtered"})
        .run([this](const PassContext& context) {
          sph::pair_sum(context.space(), context.neighbours<Real, Dim>(), context.kernel(),
                        wcsph::DensityFilter<Real>{context.read<Real>("compression_midpoint"),
                                                   context.write<Real>("compression_filtered"), Real(filter_)});
        });
  }

  // Hardly ever does it do anything.
  void faster_sound(PassList& list) {
    list.keep("sound", wcsph::AdaptiveSound::kept, [this] { return sound_.state(); });
    list.pass("faster sound")
        .reads({"compression"})
        .accumulates({"compression_rate"})
        .run([this](const PassContext& context) {
          const double softening = sound_.softening();
          if (!(softening < 1.0) || !(context.step_size() > 0.0)) return;
          exec::for_each(
              context.space(), context.count(),
              wcsph::SoftenCompression<Real>{context.read<Real>("compression"), context.write<Real>("compression_rate"),
                                             softening, context.step_size()});
          sound_.rise();
        });
  }

  template <bool BySpread>
  void shift(PassList& list) {
    declare_shift<BySpread>(list.pass("shift")).run([this](const PassContext& context) {
      sph::pair_sum(context.space(), context.neighbours<Real, Dim>(), context.kernel(), shift_sums<BySpread>(context));
    });
  }

  template <bool Radial>
  void momentum(PassList& list) {
    if (pressure_form_ == "corrected") momentum<Radial, PressureForm::corrected>(list);
    if (pressure_form_ == "difference") momentum<Radial, PressureForm::difference>(list);
    if (pressure_form_ == "conservative") momentum<Radial, PressureForm::conservative>(list);
  }

  template <bool Radial, PressureForm Form>
  void momentum(PassList& list) {
    declare_momentum<Radial, Form>(list.pass("pressure and viscosity")).run([this](const PassContext& context) {
      sph::pair_sum(context.space(), context.neighbours<Real, Dim>(), context.kernel(),
                    momentum_sums<Radial, Form>(context));
    });
  }

  void density_diffusion(PassList& list) {
    declare_diffusion(list.pass("density diffusion")).run([this](const PassContext& context) {
      sph::pair_sum(context.space(), context.neighbours<Real, Dim>(), context.kernel(), diffusion_sums(context));
    });
  }

  void all_together(PassList& list) {
    Pass& pass = list.pass("pressure, viscosity, shift and density diffusion");
    declare_shift<false>(pass);
    declare_diffusion(pass);
    declare_momentum<false, PressureForm::corrected>(pass).run([this](const PassContext& context) {
      using Shift = wcsph::Shift<Real, Dim, false>;
      using Momentum = wcsph::Momentum<Real, Dim, false, PressureForm::corrected>;
      using Diffusion = wcsph::DensityDiffusion<Real>;
      sph::pair_sum(context.space(), context.neighbours<Real, Dim>(), context.kernel(),
                    sph::Together<sph::Together<Shift, Momentum>, Diffusion>{
                        {shift_sums<false>(context), momentum_sums<false, PressureForm::corrected>(context)},
                        diffusion_sums(context)});
    });
  }

  static Pass& declare_diffusion(Pass& pass) {
    return pass.reads_neighbours({"compression_midpoint", "volume"}).accumulates({"compression_rate"});
  }

  wcsph::DensityDiffusion<Real> diffusion_sums(const PassContext& context) const {
    return {context.read<Real>("volume"), context.read<Real>("compression_midpoint"),
            context.write<Real>("compression_rate"), Real(diffusion_ * smoothing_length_ * sound_.speed())};
  }

  template <PressureForm Form>
  static constexpr const char* summed_pressure = Form == PressureForm::difference ? "pressure" : "pressure_term";

  template <bool BySpread>
  static Pass& declare_shift(Pass& pass) {
    pass.accumulates({"shift_velocity"});
    if (BySpread) return pass.reads_neighbours({"velocity"});
    // Of neighbours it needs their places alone, which come with any field that is read there.
    return pass.reads({"velocity_gradient"}).reads_neighbours({"volume"});
  }

  template <bool BySpread>
  wcsph::Shift<Real, Dim, BySpread> shift_sums(const PassContext& context) const {
    wcsph::Shift<Real, Dim, BySpread> sums{};
    if constexpr (BySpread) {
      sums.velocity = context.read<Real>("velocity");
    } else {
      sums.velocity_gradient = context.read<Real>("velocity_gradient");
    }
    sums.shift = context.write<Real>("shift_velocity");
    sums.strength = Real(shift_);
    sums.smoothing_length = Real(context.scene().smoothing_length);
    return sums;
  }

  template <bool Radial, PressureForm Form>
  static Pass& declare_momentum(Pass& pass) {
    pass.reads({"density", "correction"})
        .reads_neighbours({summed_pressure<Form>, "volume"})
        .accumulates({"acceleration"});
    return Radial ? pass.reads_neighbours({"velocity"}) : pass.reads({"velocity_laplacian"});
  }

  template <bool Radial, PressureForm Form>
  wcsph::Momentum<Real, Dim, Radial, Form> momentum_sums(const PassContext& context) const {
    wcsph::Momentum<Real, Dim, Radial, Form> sums{};
    sums.volume = context.read<Real>("volume");
    sums.pressure = context.read<Real>(summed_pressure<Form>);
    sums.density = context.read<Real>("density");
    sums.correction = context.read<Real>("correction");
    if constexpr (Radial) {
      sums.velocity = context.read<Real>("velocity");
    } else {
      sums.velocity_laplacian = context.read<Real>("velocity_laplacian");
    }
    sums.acceleration = context.write<Real>("acceleration");
    sums.viscosity = Real(viscosity_);
    sums.mass = Real(mass_);
    return sums;
  }

  double physical_density_ = 0.0;
  double density_ = 0.0;  // of the momentum equation
  double creeping_density_ = std::numeric_limits<double>::infinity();
  bool inertia_ = true;
  double relaxation_ratio_ = 20.0;
  double viscosity_ = 0.0;
  std::string viscosity_form_ = "component";
  std::optional<double> sound_speed_;
  std::optional<double> expected_speed_;
  double density_variation_ = 0.01;
  std::string pressure_form_ = "corrected";
  double diffusion_ = 0.1;
  double filter_ = 0.0;
  bool feedback_ = false;
  double shift_ = 0.3;
  std::string shift_speed_ = "strain";
  std::string motion_ = "lagrangian";
  wcsph::AdaptiveSound sound_;
  double automatic_sound_speed_ = 0.0;
  double smoothing_length_ = 0.0;  // h, m
  double mass_ = 0.0;              // of a particle, kg/m in 2D
};

}  // namespace

MESOGEN_PHYSICS_PLUGIN(Wcsph, "wcsph", "1.0.0",
                       "Weakly compressible flow: continuity, Tait pressure, viscosity, particle shifting")
