#pragma once

#include <array>
#include <string>

#include "case/case.hpp"
#include "mesogen/export.hpp"
#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/shape.hpp"
#include "plugin/plugin_pointer.hpp"

namespace mesogen {

/// A solid of a case, [solids.NAME]: where its surface is, and what holds there.
class MESOGEN_EXPORT Solid {
 public:
  using Point = Shape::Point;

  /// `keys`: the framework's own of its section.
  Solid(std::string name, PluginPointer<Shape> shape, Case::Solid keys);

  /// Refuses, by a BadParameter, what its keys cannot mean in this scene. Called once, before everything below.
  void prepare(const Scene& scene);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] Shape& shape() const { return *shape_; }
  /// From its surface, m: above 0 in the fluid, below 0 in the solid. Throws an Error if the plugin gives no number.
  [[nodiscard]] double distance(const Point& at) const;
  /// The way in which distance() grows, into the fluid: a unit vector, or zero where it has no slope.
  [[nodiscard]] Point normal(const Point& at) const;
  /// The nearest point of its surface.
  [[nodiscard]] Point nearest(const Point& at) const;
  /// About which it turns, m.
  [[nodiscard]] const Point& centre() const { return centre_; }
  /// Of its surface, m/s.
  [[nodiscard]] Point velocity(const Point& at) const;
  /// Has the fluid the velocity of its surface there?
  [[nodiscard]] bool sticks() const { return keys_.slip.word == "none"; }
  /// How a field goes on from the mirror point into the solid.
  [[nodiscard]] AffineRule rule(const FieldKind& field, const WallParticle& at) const;

 private:
  [[nodiscard]] double shape_distance(const Point& at) const;
  [[nodiscard]] AffineRule velocity_rule(const FieldKind& field, const WallParticle& at) const;
  [[nodiscard]] std::array<double, 2> wall_order(const Point& normal) const;

  std::string name_;
  PluginPointer<Shape> shape_;
  Case::Solid keys_;
  int dimension_ = 0;
  Point box_{};
  std::array<bool, 3> periodic_{};
  double step_ = 0.0;                  // for slopes, m
  double extrapolation_length_ = 0.0;  // of the order tensor, K / W, m
  Point centre_{};
};

}  // namespace mesogen
