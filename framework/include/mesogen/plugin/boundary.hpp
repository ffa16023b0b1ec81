#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesogen/fields/affine_rule.hpp"
#include "mesogen/fields/dimensions.hpp"
#include "mesogen/fields/field_kind.hpp"
#include "mesogen/plugin/parameters.hpp"
#include "mesogen/plugin/scene.hpp"

namespace mesogen {

/// How space goes on beyond the two faces of an axis.
enum class Continuation {
  wrapped,  ///< periodic: the cell grid itself continues on the other side
  ghosts,   ///< periodic: the framework repeats the particles near a face beyond the opposite one
  none,     ///< the box ends there: particles of a wall complete what the kernel sees
};

/// A particle of a wall: it never moves, and completes the support of the fluid particles near it.
struct WallParticle {
  std::array<double, 3> position{};  ///< in the wall, m
  std::array<double, 3> mirror{};  ///< the point in the fluid, as far from the wall's surface, where it takes values, m
  std::array<double, 3> normal{};  ///< of the surface between the two: a unit vector that points into the fluid
  /// Of that surface there, 1/m, in three dimensions the mean of both: above 0 where the wall bulges into the fluid.
  double curvature = 0.0;
  int wall = 0;  ///< a number of the boundary's own, to tell its walls apart
};

/// The boundary of the fluid: a region (how space goes on beyond the faces of the box, and where walls are) and
/// conditions (what fields are there). A condition is a rule by what a field is, never by its name.
///
/// Walls may stand anywhere, also inside the box and beside periodic axes. Particles of the fluid are not placed by the
/// boundary: they start as [particles] says.
class MESOGEN_EXPORT Boundary {
 public:
  /// Dimensions that it has a form for. A plugin of fewer declares the same public member again.
  static constexpr DimensionSet dimensions{AllDimensions{}};

  Boundary() = default;
  Boundary(const Boundary&) = delete;
  Boundary& operator=(const Boundary&) = delete;
  virtual ~Boundary();

  /// Keys beside the framework's own. Given in the case as `boundary = { type = "...", key = value }`.
  virtual void parameters(ParameterList& list);
  /// Says what magnitudes it brings to the scene, such as the speed of a wall. Parameters are set.
  virtual void scales(Scales& scales) const;
  /// Refuses, by an Error, what its parameters cannot mean in this scene. Called once, before everything below.
  virtual void prepare(const Scene& scene);

  // The region.

  [[nodiscard]] virtual Continuation continuation(int axis) const = 0;
  /// Does the box go on at its other side along this axis? Told to observers and written to results.
  [[nodiscard]] bool periodic(int axis) const { return continuation(axis) != Continuation::none; }
  /// How far (m) an image of the box is moved along its faces, as in a sheared box: along axis d the image lies
  /// `boxes[d]` boxes away, and this much farther. Asked for axes that continue by ghosts; by default zero.
  [[nodiscard]] virtual std::array<double, 3> shear(const Scene& scene, const std::array<int, 3>& boxes) const;
  /// Brings a particle that left the box back in; `images[d]` counts the boxes that it has crossed, so that
  /// position + images * box is its unwrapped path. Called for each that is not in [0, box) along every axis,
  /// whenever particles are sorted or a frame is written, by several threads at a time. By default it comes in at the
  /// other side of a periodic axis, and is reflected at the ends of the others.
  virtual void keep_inside(const Scene& scene, double* position, std::int32_t* images) const;
  /// Does a particle that is in the box lie where no fluid is, so that keep_inside must bring it back? Asked whenever
  /// particles are sorted, in scenes with solids. By default no.
  [[nodiscard]] virtual bool strays(const double* position) const;
  /// The particles of walls: all that a particle of the fluid can see within `reach` (m). Along periodic axes they lie
  /// inside the box; the framework makes their images. Between a wall particle and its mirror point there may be a
  /// periodic face, but no sheared one. Called once.
  [[nodiscard]] virtual std::vector<WallParticle> wall_particles(const Scene& scene, double reach) const;

  // The conditions. Both rules are by default that values stay the same.

  /// How a field goes over from particles to their ghosts in the image of the box that lies `boxes[d]` boxes away along
  /// axis d. A sheared box adds to the velocity.
  [[nodiscard]] virtual AffineRule ghost_rule(const Scene& scene, const FieldKind& field,
                                              const std::array<int, 3>& boxes) const;
  /// How a field goes on in a wall. The value at a mirror point is interpolated from the fluid: a linear field goes on
  /// exactly, and with AffineRule::curved_at a quadratic one too, of a vector its part along the wall.
  [[nodiscard]] virtual AffineRule wall_rule(const Scene& scene, const FieldKind& field, const WallParticle& at) const;
};

}  // namespace mesogen
