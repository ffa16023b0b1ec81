#include "mesogen/nematics/numbers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "mesogen/nematics/instability.hpp"
#include "mesogen/text/formatted.hpp"

namespace mesogen::nematics {

namespace {

void add(std::vector<SceneNumber>& list, const char* name, double value, const char* unit, std::string meaning) {
  if (value > 0.0 && std::isfinite(value)) list.push_back({name, value, unit, std::move(meaning)});
}

double shortest_edge(const Scene& scene) {
  return *std::min_element(scene.box.begin(), scene.box.begin() + scene.dimension);
}

double longest_edge(const Scene& scene) {
  return *std::max_element(scene.box.begin(), scene.box.begin() + scene.dimension);
}

/// That of the fluid, also where its momentum is computed with another.
double physical_density(const Scene& scene) {
  const double physical = scene.constant("physical_density");
  return physical > 0.0 ? physical : scene.constant("density");
}

/// How long the momentum of the longest wave lasts, s.
double inertial_time(const Scene& scene) {
  const double viscosity = scene.constant("viscosity");
  return viscosity > 0.0 ? physical_density(scene) * std::pow(longest_edge(scene), 2) /
                               (4.0 * std::numbers::pi * std::numbers::pi * viscosity)
                         : 0.0;
}

void add_instability(const Scene& scene, std::vector<SceneNumber>& list) {
  const auto fluid = active_fluid(scene.constants);
  if (!fluid || fluid->activity == 0.0 || !scene.endless()) return;
  const Wave wave = fastest_wave(*fluid, scene.box, uniform_director(scene));
  if (!(wave.growth_rate > 0.0)) {
    list.push_back({"growth_rate", wave.growth_rate, "1/s", "no wave that fits the box grows: nothing starts to flow"});
    return;
  }
  const char* const kind =
      wave.cosine > 0.5 ? "bend" : (wave.cosine < -0.5 ? "splay" : "a wave between bend and splay");
  add(list, "growth_rate", wave.growth_rate, "1/s", std::string("of the wave in the box that grows fastest: ") + kind);
  add(list, "growth_time", 1.0 / wave.growth_rate, "s", "time in which that wave grows e-fold");
  add(list, "growth_wave_length", wave.length, "m", "length of that wave");
  add(list, "waves_in_box", longest_edge(scene) / wave.length, "1", "how many such waves fit the longest edge");
  add(list, "growth_rate_without_inertia", wave.without_inertia, "1/s",
      "growth rate of that wave if the fluid had no mass");
  add(list, "inertia", inertial_time(scene) / (1.0 / wave.growth_rate), "1",
      "inertial time over growth time: below 0.1 the fluid's mass hardly matters");
}

}  // namespace

double active_length(const Scene& scene) {
  const double activity = std::abs(scene.constant("activity"));
  return activity > 0.0 ? std::sqrt(scene.constant("elastic_constant") / activity) : 0.0;
}

void add_core_numbers(const Scene& scene, std::vector<SceneNumber>& list) {
  const double bulk = std::abs(scene.constant("bulk_A"));
  if (!(bulk > 0.0)) return;
  const double size = std::sqrt(scene.constant("elastic_constant") / bulk);
  add(list, "core_size", size, "m", "xi = sqrt(K / |A|), of a defect's core");
  add(list, "core_size_in_spacings", size / scene.spacing, "1", "xi / dx");
}

void add_active_numbers(const Scene& scene, std::vector<SceneNumber>& list) {
  const double length = active_length(scene);
  if (!(length > 0.0)) return;
  const double activity = std::abs(scene.constant("activity"));
  const double viscosity = scene.constant("viscosity");
  add(list, "active_length", length, "m", "l_Q = sqrt(K / |zeta|)");
  add(list, "active_length_in_spacings", length / scene.spacing, "1", "l_Q / dx");
  add(list, "box_in_active_lengths", shortest_edge(scene) / length, "1", "L / l_Q, L the shortest edge of the box");
  add(list, "active_speed", active_speed(scene), "m/s",
      "|zeta| l_Q / mu, the speed that the active stress drives over l_Q");
  if (viscosity > 0.0) {
    const double speed = length * activity / scene.constant("rotational_diffusivity");
    add(list, "paper_speed", speed, "m/s",
        "v_Q = l_Q |zeta| / Gamma as in the literature, with the number of Gamma in place of a viscosity");
    add(list, "reynolds_active", physical_density(scene) * speed * length / viscosity, "1", "rho v_Q l_Q / mu");
  }
  add_instability(scene, list);
}

void add_flow_numbers(const Scene& scene, std::vector<SceneNumber>& list) {
  const double speed = scene.expected_speed();
  const double viscosity = scene.constant("viscosity");
  if (speed > 0.0 && viscosity > 0.0) {
    add(list, "speed", speed, "m/s",
        scene.scales.speed > 0.0 ? "u, the largest of expected_speed, the initial speed and the speeds of walls"
                                 : "u = |zeta| l_Q / mu, because the case names no speed");
    add(list, "reynolds_box", reynolds_number(scene), "1", "rho u L / mu");
    add(list, "mach", speed / scene.constant("sound_speed"), "1", "u / c0");
    add(list, "ericksen", viscosity * speed * shortest_edge(scene) / scene.constant("elastic_constant"), "1",
        "mu u L / K, viscous over elastic stress");
  }
  if (scene.constant("physical_density") > 0.0) {
    const double ratio = scene.constant("relaxation_ratio");
    add(list, "artificial_density", scene.constant("density"), "kg/m3",
        formatted("of the momentum equation, because inertia = false: momentum relaxes at least %.3g times faster than "
                  "the nematic changes, so growth rates are up to %.2g %% too low",
                  ratio, 100.0 / ratio));
  }
  // Does the fluid's mass matter? By the box: what fills it comes to rest last.
  add(list, "inertial_time", inertial_time(scene), "s",
      "rho L^2 / (4 pi^2 mu), in which viscosity relaxes the longest wave");
}

double active_speed(const Scene& scene) {
  const double viscosity = scene.constant("viscosity");
  return viscosity > 0.0 ? std::abs(scene.constant("activity")) * active_length(scene) / viscosity : 0.0;
}

double reynolds_number(const Scene& scene) {
  const double viscosity = scene.constant("viscosity");
  return viscosity > 0.0 ? physical_density(scene) * scene.expected_speed() * shortest_edge(scene) / viscosity : 0.0;
}

}  // namespace mesogen::nematics
