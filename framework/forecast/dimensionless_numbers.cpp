#include "forecast/dimensionless_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "forecast/instability.hpp"

namespace mesogen {

namespace {

/// What the plugins publish; 0 for what none does.
class Published {
 public:
  explicit Published(const Scene& scene) : constants_(scene.constants) {}
  [[nodiscard]] double operator()(const char* name) const {
    const auto at = constants_.find(name);
    return at == constants_.end() ? 0.0 : at->second;
  }

 private:
  const Constants& constants_;
};

double active_length(const Published& of) {
  const double activity = std::abs(of("activity"));
  return activity > 0.0 ? std::sqrt(of("elastic_constant") / activity) : 0.0;
}

double active_speed(const Published& of) {
  return of("viscosity") > 0.0 ? std::abs(of("activity")) * active_length(of) / of("viscosity") : 0.0;
}

/// The scene's numbers, topic by topic; a number that cannot be made is left out.
class Numbers {
 public:
  Numbers(const Scene& scene, std::optional<double> director)
      : scene_(scene),
        director_(director),
        of_(scene),
        box_(*std::min_element(scene.box.begin(), scene.box.begin() + scene.dimension)) {}

  std::vector<SceneNumber> all() {
    core();
    active_scales();
    flow();
    creeping();
    instability();
    return std::move(numbers_);
  }

 private:
  void add(const char* name, double value, const char* unit, std::string meaning) {
    if (value > 0.0 && std::isfinite(value)) numbers_.push_back({name, value, unit, std::move(meaning)});
  }

  /// That of the fluid, also where its momentum is computed with another.
  [[nodiscard]] double physical_density() const {
    return of_("physical_density") > 0.0 ? of_("physical_density") : of_("density");
  }

  void core() {
    const double bulk = std::abs(of_("bulk_A"));
    if (!(bulk > 0.0)) return;
    const double size = std::sqrt(of_("elastic_constant") / bulk);
    add("core_size", size, "m", "xi = sqrt(K / |A|), of a defect's core");
    add("core_size_in_spacings", size / scene_.spacing, "1", "xi / dx");
  }

  void active_scales() {
    const double length = active_length(of_);
    if (!(length > 0.0)) return;
    const double activity = std::abs(of_("activity"));
    const double viscosity = of_("viscosity");
    add("active_length", length, "m", "l_Q = sqrt(K / |zeta|)");
    add("active_length_in_spacings", length / scene_.spacing, "1", "l_Q / dx");
    add("box_in_active_lengths", box_ / length, "1", "L / l_Q, L the shortest edge of the box");
    add("active_speed", active_speed(of_), "m/s", "|zeta| l_Q / mu, what the active stress drives over l_Q");
    if (!(viscosity > 0.0)) return;
    const double speed = length * activity / of_("rotational_diffusivity");
    add("paper_speed", speed, "m/s",
        "v_Q = l_Q |zeta| / Gamma as the literature has it, Gamma's number taken for a viscosity");
    add("reynolds_active", physical_density() * speed * length / viscosity, "1", "rho v_Q l_Q / mu");
  }

  void flow() {
    const double speed = expected_speed(scene_);
    const double viscosity = of_("viscosity");
    if (!(speed > 0.0) || !(viscosity > 0.0)) return;
    add("speed", speed, "m/s",
        scene_.scales.speed > 0.0 ? "u, as expected, at the start or at a wall"
                                  : "u = |zeta| l_Q / mu; none is expected");
    add("reynolds_box", physical_density() * speed * box_ / viscosity, "1", "rho u L / mu");
    add("mach", speed / of_("sound_speed"), "1", "u / c0");
    add("ericksen", viscosity * speed * box_ / of_("elastic_constant"), "1", "mu u L / K, viscous over elastic stress");
  }

  void creeping() {
    if (!(of_("physical_density") > 0.0)) return;
    const double ratio = of_("relaxation_ratio");
    add("artificial_density", of_("density"), "kg/m3",
        fmt::format("of the momentum equation, as inertia = false: momentum relaxes at least {:.3g} times faster than "
                    "the nematic changes, so growth rates are up to {:.2g} % too low",
                    ratio, 100.0 / ratio));
  }

  // Does the fluid's mass matter? By the box: what fills it comes to rest last.
  void instability() {
    const bool periodic = scene_.periodic[0] && scene_.periodic[1];
    const double longest = *std::max_element(scene_.box.begin(), scene_.box.begin() + scene_.dimension);
    const double inertial = of_("viscosity") > 0.0 ? physical_density() * longest * longest /
                                                         (4.0 * std::numbers::pi * std::numbers::pi * of_("viscosity"))
                                                   : 0.0;
    add("inertial_time", inertial, "s", "rho L^2 / (4 pi^2 mu), the longest wave's relaxation by viscosity");
    const auto fluid = active_fluid(scene_.constants);
    if (!fluid || fluid->activity == 0.0 || !periodic) return;
    const Wave wave = fastest_wave(*fluid, scene_.box, director_);
    if (!(wave.growth_rate > 0.0)) {
      numbers_.push_back(
          {"growth_rate", wave.growth_rate, "1/s", "no wave that fits the box grows: nothing starts to flow"});
      return;
    }
    const char* const kind =
        wave.cosine > 0.5 ? "bend" : (wave.cosine < -0.5 ? "splay" : "a wave between bend and splay");
    add("growth_rate", wave.growth_rate, "1/s", std::string("of the wave in the box that grows fastest: ") + kind);
    add("growth_time", 1.0 / wave.growth_rate, "s", "by which that wave grows e-fold");
    add("growth_wave_length", wave.length, "m", "its length");
    add("waves_in_box", longest / wave.length, "1", "how many of them are in the longest edge");
    add("growth_rate_without_inertia", wave.without_inertia, "1/s", "the same if the fluid had no mass");
    add("inertia", inertial / (1.0 / wave.growth_rate), "1",
        "inertial time over growth time: below 0.1 its mass hardly matters");
  }

  const Scene& scene_;
  std::optional<double> director_;
  Published of_;
  double box_;
  std::vector<SceneNumber> numbers_;
};

}  // namespace

double expected_speed(const Scene& scene) {
  return scene.scales.speed > 0.0 ? scene.scales.speed : active_speed(Published(scene));
}

std::vector<SceneNumber> dimensionless_numbers(const Scene& scene, std::optional<double> director) {
  return Numbers(scene, director).all();
}

}  // namespace mesogen
