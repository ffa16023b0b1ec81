#pragma once

#include <array>

#include "mesogen/export.hpp"
#include "mesogen/fields/dimensions.hpp"
#include "mesogen/plugin/parameters.hpp"
#include "mesogen/plugin/scene.hpp"

namespace mesogen {

/// A shape of a solid: a region of space, given by how far its surface is. The case says on which side of the surface
/// the fluid is, and what holds there; see [solids.NAME].
class MESOGEN_EXPORT Shape {
 public:
  /// Dimensions that it has a form for. A plugin of fewer declares the same public member again.
  static constexpr DimensionSet dimensions{AllDimensions{}};

  using Point = std::array<double, 3>;  ///< coordinates, m; zero along axes that the scene has not

  Shape() = default;
  Shape(const Shape&) = delete;
  Shape& operator=(const Shape&) = delete;
  virtual ~Shape();

  /// Keys beside the framework's own (shape, fluid, velocity, ...).
  virtual void parameters(ParameterList& list);
  /// Refuses, by a BadParameter, what its parameters cannot mean. Called once, before everything below.
  virtual void prepare(const Scene& scene);
  /// Signed distance from the surface, m: below 0 inside the shape, above 0 outside. It must be right near the surface,
  /// as far as the kernel reaches; farther away its sign is enough. The framework finds normals by its slope. The shape
  /// goes on in every periodic image of the box: the framework asks for those too.
  [[nodiscard]] virtual double distance(const Point& at) const = 0;
  /// The point around which a solid of this shape turns, m.
  [[nodiscard]] virtual Point centre() const = 0;
};

}  // namespace mesogen
