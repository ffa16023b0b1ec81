#include "advice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesogen/nematics/numbers.hpp"
#include "mesogen/text/formatted.hpp"
#include "sound_speed.hpp"

namespace mesogen::wcsph {

namespace {

constexpr double creeping = 0.1;    // Reynolds number by the box below which inertia plays no part
constexpr double worthwhile = 1.5;  // times fewer steps: below, the error is not worth it

// Between walls the velocity of an active nematic is off by this times (dx / l_Q)^2, l_Q the active length (root of the
// mean square against Stokes flow of the same stress: 6 to 8 % with 3.5 spacings, 1.9 % with 7; docs/flows.md).
constexpr double error_of_flow = 0.9;

constexpr double good_spacings = 7.0;  // in an active length: 1.8 % off

// Where it takes more than these, a smaller spacing is no help.
constexpr double most_particles = 2e7;

/// "140", where two digits of %g would be "1.4e+02".
std::string two_digits(double number) {
  const double unit = std::pow(10.0, std::floor(std::log10(number)) - 1.0);
  return formatted("%.12g", std::round(number / unit) * unit);
}

// By the fluid's mass, which a creeping flow does not feel, viscosity binds explicit steps, and asks for stages of
// stabilised ones: for as many as the square root of what it would bind them by.
void advise_on_inertia(const FlowChoice& flow, const AdviceContext& context, std::vector<Suggestion>& list) {
  if (!flow.inertia || !std::isfinite(flow.creeping_density) || !(flow.creeping_density > worthwhile * flow.density))
    return;
  const double reynolds = nematics::reynolds_number(context.scene);
  if (!(reynolds > 0.0) || reynolds >= creeping) return;
  const double ratio = flow.creeping_density / flow.density;
  const bool staged = context.scene.stabilised_steps;
  const std::string fewer = staged ? two_digits(std::sqrt(ratio)) + " times fewer stages in a step"
                                   : std::string("as many times fewer steps");
  list.push_back(
      {"no_inertia",
       formatted("the Reynolds number of the box is %.2g: the fluid's mass has no effect on this flow, but %s",
                 reynolds, staged ? "asks for many stages in a step" : "limits the step"),
       {context.section + ".inertia=false"},
       formatted("an artificial density that is %s times the fluid's, and %s; growth rates are up to 5 %% too low",
                 two_digits(ratio).c_str(), fewer.c_str())});
}

// Density varies as the square of speed over sound speed.
void advise_on_sound(const FlowChoice& flow, const AdviceContext& context, std::vector<Suggestion>& list) {
  const double sound = flow.sound_speed;
  const double automatic = flow.automatic_sound_speed;
  const bool binds = context.binding == StepCause::sound && !context.step_is_given;
  const std::string unit = context.unit("m/s");
  const std::vector<std::string> settings{context.section + ".sound_speed=auto"};
  if (sound > 0.0 && sound < 0.7 * automatic) {
    const bool free = context.binding != StepCause::sound && !context.step_is_given;
    list.push_back(
        {"sound_too_slow",
         formatted("the sound speed, %.3g %s, is lower than this flow and its stresses need, %.3g %s%s", sound,
                   unit.c_str(), automatic, unit.c_str(), free ? "; up to that value a higher one costs nothing" : ""),
         settings, formatted("the density varies some %.2g times less", std::pow(automatic / sound, 2))});
  }
  if (binds && automatic > 0.0 && sound > 1.4 * automatic)
    list.push_back(
        {"sound_too_fast",
         formatted(
             "the sound speed, %.3g %s, limits the step and is higher than this flow and its stresses need, %.3g %s",
             sound, unit.c_str(), automatic, unit.c_str()),
         settings, formatted("%.2g times fewer steps", sound / automatic)});
}

// What a creeping flow compresses is an artificial density. Measured in channels (docs/flows.md), so for walls alone.
void advise_on_variation(const FlowChoice& flow, const AdviceContext& context, std::vector<Suggestion>& list) {
  const Scene& scene = context.scene;
  const bool binds = context.binding == StepCause::sound && !context.step_is_given && scene.stabilised_steps;
  if (!(flow.slower_sound_speed > 0.0) || !binds || scene.endless()) return;
  const double fewer = std::pow(flow.sound_speed / flow.slower_sound_speed, 2);
  if (fewer < worthwhile) return;
  list.push_back(
      {"creeping_sound",
       formatted("the speed of sound is chosen for a density that varies by %.2g, but that of a creeping flow is "
                 "artificial, and limits the step",
                 usual_variation),
       {formatted("%s.density_variation=%.2g", context.section.c_str(), creeping_variation)},
       formatted("up to %.2g times fewer steps, with more stages each; the velocity lags behind its forces by about a "
                 "step, then %.2g %s",
                 fewer, fewer * flow.sound_step, context.unit("s").c_str())});
}

void advise_on_spacing(const AdviceContext& context, std::vector<Suggestion>& list) {
  const Scene& scene = context.scene;
  const double spacings = nematics::active_length(scene) / scene.spacing;
  if (scene.endless() || !(spacings > 0.0) || spacings >= nematics::few_in_active_length) return;
  const auto percent = [](double number) { return 100.0 * error_of_flow / (number * number); };
  const std::string finding =
      formatted("the active length is only %.2g spacings: between walls the velocity is off by ", spacings) +
      (spacings < 2.0 ? "more than 20 %" : formatted("some %.2g %%", percent(spacings)));
  const double wanted = context.fitting_spacing(scene.spacing * spacings / good_spacings);
  const double more = std::pow(scene.spacing / wanted, scene.dimension);
  if (more * static_cast<double>(scene.particle_count) > most_particles) {
    list.push_back({"flow_under_resolved",
                    finding,
                    {},
                    formatted("an active length of %.2g spacings needs %.2g times as many particles; instead, choose a "
                              "smaller box, a smaller activity or a larger elastic constant",
                              good_spacings, more)});
  } else {
    list.push_back({"flow_under_resolved",
                    finding,
                    {formatted("particles.spacing=%.12g", wanted)},
                    formatted("the velocity is off by some %.2g %%, with %.2g times as many particles",
                              percent(good_spacings), more)});
  }
}

// An incompressible flow, where what sound and viscosity allow is far below what motion and the rest of the physics
// need, or where viscosity is taken in stages: a step without them, and without sums over pairs, is cheaper. With keys
// of its own the case asks for this plugin.
void advise_on_another_flow(const FlowChoice& flow, const AdviceContext& context, std::vector<Suggestion>& list) {
  const Scene& scene = context.scene;
  if (!scene.endless() || !flow.only_defaults) return;
  double others = std::numeric_limits<double>::infinity();
  for (const auto& limit : context.limits.all())
    // Diffusion and friction limit no step of that flow.
    if (limit.cause != StepCause::sound && limit.cause != StepCause::viscosity &&
        limit.cause != StepCause::elasticity && limit.cause != StepCause::friction)
      others = std::min(others, limit.seconds);
  if (scene.scales.speed > 0.0) others = std::min(others, 0.2 * scene.spacing / scene.scales.speed);
  const bool staged = scene.stabilised_steps;
  if (!staged && !(others > 4.0 * flow.step)) return;
  list.push_back({"no_sound",
                  staged ? "viscosity is taken in stages, and this box is periodic: an incompressible flow needs no "
                           "stages and no sums over neighbours"
                         : "sound or viscosity limits the step, and this box is periodic: in an incompressible flow "
                           "neither limits the step",
                  {context.section + ".type=incompressible"},
                  std::string(staged ? "cheaper" : "far fewer") +
                      " steps, and a flow as accurate as Fourier series. It has no sound, compression, equation of the "
                      "density or walls"});
}

}  // namespace

void advise(const FlowChoice& flow, const AdviceContext& context, std::vector<Suggestion>& list) {
  advise_on_inertia(flow, context, list);
  advise_on_spacing(context, list);
  advise_on_variation(flow, context, list);
  advise_on_sound(flow, context, list);
  advise_on_another_flow(flow, context, list);
}

}  // namespace mesogen::wcsph
