#pragma once

#include <array>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "mesogen/export.hpp"
#include "mesogen/fields/field_view.hpp"
#include "mesogen/fields/rank.hpp"
#include "mesogen/plugin/wall_surface.hpp"

namespace mesogen {

/// Magnitudes that plugins tell each other through the framework, so that one can choose its numerics by another's
/// physics without knowing it. Each is the largest that any plugin gave; 0: nobody did.
struct Scales {
  double stress = 0.0;  ///< largest lasting stress beside pressure and viscosity, Pa
  /// Largest stress that comes and goes, such as that of a distorted start: a flow has to survive it, Pa.
  double passing_stress = 0.0;
  double speed = 0.0;  ///< expected or initial speed, m/s
  /// Speed that the stresses of the scene drive, if nothing tells of a speed, m/s.
  double driven_speed = 0.0;
  /// Fields whose Laplacian, as a plugin makes it, takes any step: their diffusion limits none.
  std::set<std::string, std::less<>> laplacians_for_any_step;
  bool friction_for_any_step = false;  ///< the flow takes the constant `friction` into account in steps of any length
};

/// A field as the initial conditions set it.
struct InitialExtent {
  double largest = 0.0;    ///< largest length of it on a particle (of an order tensor, its order q), in its unit
  double laplacian = 0.0;  ///< of an order tensor, largest length of its Laplacian, also by what walls hold it at, 1/m2
};

/// Numbers that plugins publish for observers and for each other, by name.
using Constants = std::map<std::string, double, std::less<>>;

/// What a plugin may know of the case beside its own parameters: fixed before the run starts.
struct Scene {
  int dimension = 0;  ///< of space: how many numbers domain.size has
  Precision precision = Precision::single_precision;
  std::array<double, 3> box{};                     ///< edge lengths, m
  std::array<bool, 3> periodic{true, true, true};  ///< by axis: does the box go on at its other side? Not at walls
  bool solids = false;                             ///< are there solids in the box
  double fluid_volume = 0.0;                       ///< what the fluid fills of the box, m^dimension
  double widest = 0.0;                             ///< with solids: largest distance between walls in the fluid, m
  std::vector<WallSurface> surfaces;               ///< of walls: faces of the box that are not periodic, then solids
  /// How deep a point of the box lies in a solid, m; 0 in the fluid. Empty without solids.
  std::function<double(const std::array<double, 3>&)> depth_in_solid;
  /// Does the fluid go on without end along every axis: no walls, no solids?
  [[nodiscard]] bool endless() const {
    bool all = !solids;
    for (int d = 0; d < dimension; ++d) all = all && periodic[static_cast<std::size_t>(d)];
    return all;
  }
  double spacing = 0.0;           ///< initial distance of particles dx, m
  double smoothing_length = 0.0;  ///< h, m
  double support = 0.0;           ///< radius of the kernel, m
  /// Largest step x diffusivity for which the Laplacian of this run, with its kernel and time scheme, is stable (with a
  /// margin for disordered particles), m2: limit a diffusion D to steps of diffusion_step / D.
  double diffusion_step = 0.0;
  /// The same of a diffusion of a certain field that is declared (PassList::diffusion); infinite if that takes any
  /// step. For a diffusion that a pass of your own sums, take diffusion_step.
  [[nodiscard]] double diffusion_step_of(std::string_view field) const {
    const bool any = stabilised_steps || scales.laplacians_for_any_step.contains(field);
    return any ? std::numeric_limits<double>::infinity() : diffusion_step;
  }
  /// Are steps stabilised (time.stepping)? Linear terms that plugins declare (LinearTerm) then limit no step. In a
  /// step, passes that the acceleration needs see the velocity at its start, all others that at its middle.
  bool stabilised_steps = false;
  Index particle_count = 0;
  /// By field; without those that no initial condition sets.
  std::map<std::string, InitialExtent, std::less<>> initial;
  [[nodiscard]] InitialExtent initial_extent(std::string_view field) const {
    const auto found = initial.find(field);
    return found == initial.end() ? InitialExtent{} : found->second;
  }
  std::set<std::string, std::less<>> varying;  ///< fields of numbers that vary (Parameter::may_vary)
  Scales scales;                               ///< what the physics plugins said of their magnitudes
  Constants constants;                         ///< what plugins published by name
  /// A published number, or `otherwise` if nobody published it.
  [[nodiscard]] double constant(std::string_view name, double otherwise = 0.0) const {
    const auto found = constants.find(name);
    return found == constants.end() ? otherwise : found->second;
  }
  /// The speed that is expected, m/s: what plugins tell, or else what stresses drive; 0 if nothing is known.
  [[nodiscard]] double expected_speed() const { return scales.speed > 0.0 ? scales.speed : scales.driven_speed; }
};

}  // namespace mesogen
