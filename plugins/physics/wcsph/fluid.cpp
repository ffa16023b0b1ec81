#include "fluid.hpp"

#include <algorithm>
#include <cmath>

#include "advice.hpp"
#include "creeping.hpp"
#include "mesogen/diagnostics/error.hpp"
#include "mesogen/nematics/numbers.hpp"
#include "sound_speed.hpp"

namespace mesogen::wcsph {

void Fluid::parameters(ParameterList& list) {
  list.number("density", physical_density_).unit("kg/m3").above(0).required().doc("rho0: reference density");
  list.number("viscosity", viscosity_).unit("Pa s").above(0).required().doc("mu: dynamic viscosity");
  list.flag("inertia", inertia_)
      .doc(
          "true: solve the momentum equation with the fluid's density. false: creeping (Stokes) flow, with an "
          "artificial density, as large as relaxation_ratio allows; the field `density` is then the artificial one");
  list.number("relaxation_ratio", relaxation_ratio_)
      .unit("1")
      .at_least(2)
      .doc(
          "momentum relaxes at least this many times faster than the nematic changes. Growth rates are too low by up "
          "to 1 / relaxation_ratio; the number of explicit steps grows in proportion to it, stages of stabilised ones "
          "with its root")
      .only_with("inertia", {"false"});
  list.number_or("sound_speed", sound_speed_, "auto")
      .unit("m/s")
      .above(0)
      .doc(
          "c0; auto: the largest of 10 times the expected speed, sqrt(stress / (rho delta)), and the speed up to which "
          "viscosity, not sound, limits explicit steps. With auto, c0 rises during a run, and steps get shorter, if "
          "the "
          "largest |rho / rho0 - 1| exceeds 3 times density_variation on average over the time that sound takes "
          "through the box, or 10 times at any moment, or if the flow is faster than half of c0. A c0 that is given "
          "does not change, nor does any c0 with a given time.step");
  list.number_or("expected_speed", expected_speed_, "auto")
      .unit("m/s")
      .at_least(0)
      .doc("largest speed that the flow will reach, from which c0 is chosen; auto: the largest speed at the start");
  list.number("density_variation", density_variation_)
      .unit("1")
      .above(0)
      .at_most(0.1)
      .doc(
          "delta: relative variation of the density for which c0 is chosen; a smaller one needs a higher c0 and so "
          "shorter steps");
}

void Fluid::publish(Scene& scene) const {
  scene.scales.speed =
      std::max({scene.scales.speed, expected_speed_.value_or(0.0), scene.initial_extent("velocity").largest});
  scene.constants["viscosity"] = viscosity_;
  scene.constants["density"] = inertia_ ? physical_density_ : artificial_density(scene);
  if (inertia_) return;
  scene.constants["physical_density"] = physical_density_;
  scene.constants["relaxation_ratio"] = relaxation_ratio_;
}

void Fluid::declare(const Scene& scene, PassList& list, bool radial, bool plain) {
  radial_ = radial;
  choose(scene);
  list.constant("sound_speed", sound_.speed());
  list.numbers(nematics::add_flow_numbers);
  list.step_limit(StepCause::sound, scene.stabilised_steps ? "0.25 h / c0 or 2 mu / rho c0^2" : "0.25 h / c0",
                  [this](const Scene& run) { return sound_step(run); });
  if (scene.stabilised_steps && !(scene.scales.stress > 0.0))
    list.step_limit(StepCause::viscosity, "0.01 rho / (mu k^2 + xi) of the longest wave", [this](const Scene& run) {
      return 0.01 * density_ / (viscosity_ * smallest_square(run) + run.constant("friction"));
    });
  constexpr const char* rule = "stable diffusion by mu / rho";
  if (radial)
    list.step_limit(StepCause::viscosity, rule, [this](const Scene& run) { return viscous_step(run); });
  else
    list.diffusion("velocity", "acceleration", viscosity_, StepCause::viscosity, rule).divided_by("density", density_);
  plain = plain && density_variation_ == usual_variation;
  const bool usual_creeping = plain && !inertia_ && !sound_speed_;
  list.advice([this, plain, usual_creeping](const AdviceContext& context, std::vector<Suggestion>& suggestions) {
    advise({sound_.speed(), automatic_sound_speed_, physical_density_, artificial_density(context.scene), inertia_,
            usual_creeping ? automatic_speed(context.scene, creeping_variation) : 0.0, sound_step(context.scene),
            std::min(sound_step(context.scene), viscous_step(context.scene)), plain},
           context, suggestions);
  });
}

void Fluid::choose(const Scene& scene) {
  density_ = scene.constant("density");
  if (!std::isfinite(density_))
    throw BadParameter("inertia",
                       "a creeping flow needs to know how fast the scene changes, and nothing in it tells: there is no "
                       "nematic, moving wall or initial velocity. Give expected_speed, the largest speed of the flow, "
                       "or leave inertia out");
  automatic_sound_speed_ = automatic_speed(scene, density_variation_);
  sound_.start(sound_speed_.value_or(automatic_sound_speed_), density_variation_,
               *std::max_element(scene.box.begin(), scene.box.begin() + scene.dimension), !sound_speed_);
  smoothing_length_ = scene.smoothing_length;
  mass_ = density_ * std::pow(scene.spacing, scene.dimension);
}

// Above what is needed the sound may be as fast, at no cost, as the acoustic limit on the step meets the viscous one.
double Fluid::automatic_speed(const Scene& scene, double variation) const {
  const double shortest = *std::min_element(scene.box.begin(), scene.box.begin() + scene.dimension);
  const double needed = needed_sound_speed(density_, viscosity_, variation, scene.scales, shortest);
  return std::max(needed, 0.25 * scene.smoothing_length / viscous_step(scene));
}

double Fluid::artificial_density(const Scene& scene) const {
  return creeping_density(scene, viscosity_, relaxation_ratio_);
}

// In stabilised steps a wave of wave number k that viscosity overdamps (nu k > 2 c0, nu = mu / rho0) is stable up to
// 2 nu / c0^2, however short it is; others up to 2 / (c0 k).
double Fluid::sound_step(const Scene& scene) const {
  const double c0 = sound_.speed();
  const double crossing = 0.25 * scene.smoothing_length / c0;
  return scene.stabilised_steps ? std::max(crossing, 2.0 * viscosity_ / density_ / (c0 * c0)) : crossing;
}

// The radial form takes up to 3.3 times as much from the shortest waves as the Laplacian of the components.
double Fluid::viscous_step(const Scene& scene) const {
  const double longest = radial_ ? 0.25 * scene.diffusion_step : scene.diffusion_step_of("velocity");
  return longest * density_ / viscosity_;
}

}  // namespace mesogen::wcsph
