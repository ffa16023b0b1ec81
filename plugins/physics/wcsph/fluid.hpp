#pragma once

// The fluid of a weakly compressible flow, its density and its sound: what wcsph and wcsph_published share beside their
// sums over neighbours.

#include <algorithm>
#include <optional>

#include "adaptive_sound.hpp"
#include "mesogen/plugin/parameters.hpp"
#include "mesogen/plugin/passes.hpp"
#include "mesogen/plugin/scene.hpp"
#include "sound_speed.hpp"

namespace mesogen::wcsph {

class Fluid {
 public:
  void parameters(ParameterList& list);
  /// Density, viscosity and speed.
  void publish(Scene& scene) const;
  /// Chooses density and sound, and declares viscosity, limits on the step, numbers and advice. `radial`: the plugin
  /// sums viscosity itself, in the form of Monaghan & Gingold. `plain`: the case gives no key of the plugin's own, so
  /// that another flow would do as well.
  void declare(const Scene& scene, PassList& list, bool radial, bool plain);

  /// rho0 of the momentum equation, kg/m3; with inertia = false the artificial one.
  [[nodiscard]] double density() const { return density_; }
  [[nodiscard]] double viscosity() const { return viscosity_; }
  [[nodiscard]] bool inertia() const { return inertia_; }
  /// rho0 c0^2, Pa.
  [[nodiscard]] double stiffness() const { return density_ * sound_.speed() * sound_.speed(); }
  /// Of a particle, kg/m in 2D.
  [[nodiscard]] double mass() const { return mass_; }
  /// delta h c0, m2/s; where viscosity overdamps sound over a smoothing length (nu > h c0), as much less as compression
  /// relaxes more slowly there: delta h^2 c0^2 / nu. It is then always the same part of what pressure evens out.
  [[nodiscard]] double density_diffusivity(double delta) const {
    const double way = smoothing_length_ * sound_.speed();
    return delta * way * std::min(1.0, way * density_ / viscosity_);
  }
  [[nodiscard]] AdaptiveSound& sound() { return sound_; }

 private:
  /// c0 as it is chosen for this variation of the density.
  [[nodiscard]] double automatic_speed(const Scene& scene, double variation) const;
  [[nodiscard]] double artificial_density(const Scene& scene) const;
  [[nodiscard]] double sound_step(const Scene& scene) const;
  [[nodiscard]] double viscous_step(const Scene& scene) const;
  void choose(const Scene& scene);

  double physical_density_ = 0.0;
  double density_ = 0.0;
  bool inertia_ = true;
  double relaxation_ratio_ = 20.0;
  double viscosity_ = 0.0;
  std::optional<double> sound_speed_;
  std::optional<double> expected_speed_;
  double density_variation_ = usual_variation;
  AdaptiveSound sound_;
  double automatic_sound_speed_ = 0.0;
  bool radial_ = false;
  double smoothing_length_ = 0.0;  // h, m
  double mass_ = 0.0;
};

}  // namespace mesogen::wcsph
