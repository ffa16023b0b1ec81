#pragma once

#include <array>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "mesogen/export.hpp"
#include "mesogen/field/rank.hpp"
#include "mesogen/field/view.hpp"

namespace mesogen {

/// Magnitudes that plugins tell each other through the framework, so that one can choose its numerics by another's
/// physics without knowing it. Each is the largest that any plugin gave; 0: nobody did.
struct Scales {
  double stress = 0.0;  ///< largest lasting stress beside pressure and viscosity, Pa
  /// Largest stress that comes and goes, such as that of a distorted start: a flow has to survive it, Pa.
  double passing_stress = 0.0;
  double speed = 0.0;  ///< expected or initial speed, m/s
  /// Fields whose Laplacian, as a plugin makes it, takes any step: their diffusion limits none. Of the order tensor, if
  /// the nematic tells its diffusivity by the constants rotational_diffusivity and elastic_constant.
  std::set<std::string, std::less<>> laplacians_for_any_step;
  bool friction_for_any_step = false;  ///< the flow takes the constant `friction` into account in steps of any length
};

/// How the order tensor is distorted when the run starts, also by what walls hold it at.
struct Distortion {
  double laplacian = 0.0;     ///< largest |lap Q| = sqrt((lap Q11)^2 + (lap Q12)^2) of a particle, 1/m2
  double lowest_order = 0.0;  ///< smallest and largest order q of a particle
  double highest_order = 0.0;
  double wall_jump = 0.0;  ///< largest angle between the director next to a wall and the one that it holds, rad
  std::optional<double> wall_angle;  ///< of that one, rad; nothing where walls hold several, or none of them any
};

/// Numbers that physics plugins publish for observers and for each other: "elastic_constant", "density", ...
using Constants = std::map<std::string, double, std::less<>>;

/// What a plugin may know of the case beside its own parameters: fixed before the run starts.
struct Scene {
  int dimension = 2;
  Precision precision = Precision::single_precision;
  std::array<double, 3> box{};                     ///< edge lengths, m
  std::array<bool, 3> periodic{true, true, true};  ///< by axis: does the box go on at its other side? Not at walls
  double spacing = 0.0;                            ///< initial distance of particles dx, m
  double smoothing_length = 0.0;                   ///< h, m
  double support = 0.0;                            ///< radius of the kernel, m
  /// Largest step x diffusivity for which the Laplacian of this run, with its kernel and time scheme, is stable (with a
  /// margin for disordered particles), m2: limit a diffusion D to steps of diffusion_step / D.
  double diffusion_step = 0.0;
  /// The same of the Laplacian of a certain field; infinite if that takes any step.
  [[nodiscard]] double diffusion_step_of(std::string_view field) const {
    return scales.laplacians_for_any_step.contains(field) ? std::numeric_limits<double>::infinity() : diffusion_step;
  }
  Index particle_count = 0;
  Distortion distortion;  ///< zero where the case has no director
  Scales scales;          ///< what the physics plugins said of their magnitudes
  Constants constants;    ///< what they published by name
};

/// Limits on the step; the smallest binds, and its name is reported.
class MESOGEN_EXPORT StepLimits {
 public:
  struct Limit {
    std::string name;
    double seconds;
  };
  /// `name` says what limits, such as "friction: 0.25 rho / xi"; infinite: it does not.
  void add(std::string name, double seconds);
  [[nodiscard]] const std::vector<Limit>& all() const { return limits_; }

 private:
  std::vector<Limit> limits_;
};

}  // namespace mesogen
