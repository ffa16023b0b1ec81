#pragma once

#include <array>
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

/// What happens at the faces of the box.
class MESOGEN_EXPORT Boundary {
 public:
  Boundary() = default;
  Boundary(const Boundary&) = delete;
  Boundary& operator=(const Boundary&) = delete;
  virtual ~Boundary();

  /// Keys beside the framework's own. Given in the case as `boundary = { type = "...", key = value }`.
  virtual void parameters(ParameterList& list);
  /// Does the cell grid continue on the other side along this axis (no copies needed)?
  [[nodiscard]] virtual bool wraps(int axis) const = 0;
  /// Brings a particle that left the box back in; `images[d]` counts the boxes it has crossed, so that
  /// position + images * box is its unwrapped path. Called whenever particles are sorted anew, for each particle.
  virtual void keep_inside(const Scene& scene, double* position, std::int32_t* images) const = 0;
  /// Copies needed so that every particle of the box finds all neighbours within `reach`. `position[d]` points to the
  /// coordinates of all particles. The order of the copies must not depend on the number of threads.
  virtual void copies(const Scene& scene, const double* const* position, Index count, double reach, Copies& out) const;
  /// Writes the value of one field's component at every copy. As the field stands, copies follow the real particles.
  /// By default each takes its source's value.
  virtual void refresh(const Copies& copies, FieldView<float> field, int components, Index count) const;
  virtual void refresh(const Copies& copies, FieldView<double> field, int components, Index count) const;
};

}  // namespace mesogen
