#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "mesogen/field/view.hpp"
#include "mesogen/plugin/parameters.hpp"
#include "mesogen/plugin/scene.hpp"

namespace mesogen {

/// Copies of particles beyond the faces of the box.
struct Copies {
  std::vector<Index> source;                  ///< particle that each copies
  std::vector<std::array<double, 3>> offset;  ///< position of the copy minus that of its source, m
};

/// Fixed particles beyond the faces: a wall. They complete the support of the particles near it and never move.
struct Dummies {
  std::vector<std::array<double, 3>> position;  ///< beyond a face of an axis that does not wrap, m
  std::vector<std::array<double, 3>> mirror;    ///< point inside the box from which each takes its values, m
};

/// The value of a component at a dummy or a copy: factor * (value at the mirror point, or of its source) + summand.
struct Extension {
  double factor = 1.0;
  double summand = 0.0;
};

/// What happens at the faces of the box. Beyond them may lie copies, which move with particles, or dummies, which stay
/// where they are; not both.
class MESOGEN_EXPORT Boundary {
 public:
  Boundary() = default;
  Boundary(const Boundary&) = delete;
  Boundary& operator=(const Boundary&) = delete;
  virtual ~Boundary();

  /// Keys beside the framework's own. Given in the case as `boundary = { type = "...", key = value }`.
  virtual void parameters(ParameterList& list);
  /// Says what magnitudes it brings to the scene, such as the speed of a wall. Parameters are set.
  virtual void scales(Scales& scales) const;
  /// Refuses, by an Error, what its parameters cannot mean in this scene. Before everything below, once.
  virtual void prepare(const Scene& scene);
  /// Does the box go on at its other side along this axis? By default yes. Told to observers and written to results.
  [[nodiscard]] virtual bool periodic(int axis) const;
  /// Does the cell grid itself continue on the other side along this axis (nothing is needed beyond its faces)?
  [[nodiscard]] virtual bool wraps(int axis) const = 0;
  /// Brings a particle that left the box back in; `images[d]` counts the boxes it has crossed, so that
  /// position + images * box is its unwrapped path. Called whenever particles are sorted anew, for each that is not in
  /// [0, box) along every axis.
  virtual void keep_inside(const Scene& scene, double* position, std::int32_t* images) const = 0;
  /// Copies needed so that every particle of the box finds all neighbours within `reach`. `position[d]` points to the
  /// coordinates of all particles. The order of the copies must not depend on the number of threads.
  virtual void copies(const Scene& scene, const double* const* position, Index count, double reach, Copies& out) const;
  /// How a field goes over from particles to their copies: `extension[n * components + c]` is for component c of copy
  /// n. They come as "the same".
  virtual void carry_over(const Scene& scene, std::string_view field, int components, const Copies& copies,
                          std::vector<Extension>& extension) const;
  /// Dummies needed so that every particle of the box has neighbours all around it, as far as `reach` (m). Called once.
  virtual void dummies(const Scene& scene, double reach, Dummies& out) const;
  /// How a field goes on behind the wall: `extension[n * components + c]` is for component c at dummy n. They come as
  /// "the same on both sides" (no slope at the wall); 2 v - (value at the mirror point) holds the field at v there.
  /// The value at a mirror point is interpolated from the particles, exactly where the field is linear.
  virtual void extend(const Scene& scene, std::string_view field, int components, const Dummies& dummies,
                      std::vector<Extension>& extension) const;
};

}  // namespace mesogen
