#pragma once

#include <array>
#include <deque>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mesogen/export.hpp"
#include "mesogen/fields/dimensions.hpp"
#include "mesogen/fields/field_view.hpp"
#include "mesogen/fields/rank.hpp"
#include "mesogen/plugin/parameters.hpp"
#include "mesogen/plugin/passes.hpp"
#include "mesogen/plugin/scene.hpp"

namespace mesogen {

/// Which fields an initial condition sets.
class MESOGEN_EXPORT InitialPlan {
 public:
  /// A field that it sets. If a physics plugin of the case declares the field too, both must give it the same rank.
  FieldDeclaration& sets(std::string_view field, Rank rank);
  /// The same for the velocity of the fluid, which walls hold: a boundary treats the field so also in a case without a
  /// flow plugin.
  FieldDeclaration& sets_velocity(std::string_view field);
  /// What it sets means something only where particles move with the fluid; a case in which they stay is refused.
  void needs_moving_particles() { needs_motion_ = true; }

  [[nodiscard]] const std::deque<FieldDeclaration>& fields() const { return fields_; }
  [[nodiscard]] bool moving_particles_needed() const { return needs_motion_; }
  /// The field of sets_velocity; empty if there is none.
  [[nodiscard]] const std::string& velocity() const { return velocity_; }

 private:
  std::deque<FieldDeclaration> fields_;
  std::string velocity_;
  bool needs_motion_ = false;
};

/// The particles at the start of a run, by id: particle n has the id n.
class MESOGEN_EXPORT InitialState {
 public:
  using Positions = std::array<std::span<const double>, 3>;
  InitialState(const Scene& scene, const InitialPlan& plan, const Positions& position);

  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] Index count() const { return static_cast<Index>(position_[0].size()); }
  /// Coordinate of each particle along an axis, in [0, box), m.
  [[nodiscard]] std::span<const double> position(int axis) const;
  /// One component of a field that the plan names, a number for each particle; 0 until it is set. Throws Error for a
  /// field or component that the plan does not have.
  [[nodiscard]] std::span<double> component(std::string_view field, int component = 0);

 private:
  const Scene& scene_;
  Positions position_;
  std::map<std::string, std::vector<std::vector<double>>, std::less<>> values_;
};

/// An initial condition: sets fields when a run starts. Its section of the case has the name of the plugin, [director],
/// and holds its parameters. Calls come in the order below.
class MESOGEN_EXPORT Initial {
 public:
  /// Dimensions that it has a form for. A plugin of fewer declares the same public member again.
  static constexpr DimensionSet dimensions{AllDimensions{}};

  Initial() = default;
  Initial(const Initial&) = delete;
  Initial& operator=(const Initial&) = delete;
  virtual ~Initial();

  /// Names the keys of its section of the case. Also called without a case, for `plugin info`.
  virtual void parameters(ParameterList& list);
  /// Names the fields that it sets. Also called with default parameters, for `plugin info`.
  virtual void plan(InitialPlan& plan) const = 0;
  /// Refuses, by BadParameter, what its parameters cannot mean in this scene, and adds numbers for other plugins to
  /// scene.constants. The scene has the box, the particles and constants that follow from parameters alone.
  virtual void publish(Scene& scene);
  /// Sets the fields. Results must not depend on the number of threads: random numbers go by particle
  /// (exec/random.hpp).
  virtual void set(InitialState& state) const = 0;

  /// A unit of the case in the place of an SI unit, for messages: "um" for "m". The framework sets it before publish().
  std::function<std::string(std::string_view si)> unit = [](std::string_view si) { return std::string(si); };
};

}  // namespace mesogen
