#pragma once

#include <cstdint>

#include "exec/backend.hpp"
#include "mesogen/fields/field_view.hpp"

namespace mesogen::exec {

/// Coordinates along the paths of particles, without jumps at the faces of the box.
struct UnwrappedAlong {
  const double* position;      ///< m
  const std::int32_t* images;  ///< how many boxes away
  double length;               ///< of the box, m
};

/// Values of particles that change places in storage.
class StorageLoops {
 public:
  StorageLoops() = default;
  StorageLoops(const StorageLoops&) = delete;
  StorageLoops& operator=(const StorageLoops&) = delete;
  virtual ~StorageLoops() = default;

  /// to[n] = from[order[n]] for `count` places n.
  virtual void gather(const float* from, const Index* order, Index count, float* to) const = 0;
  virtual void gather(const double* from, const Index* order, Index count, double* to) const = 0;
  virtual void gather(const std::int32_t* from, const Index* order, Index count, std::int32_t* to) const = 0;
  virtual void gather(const std::int64_t* from, const Index* order, Index count, std::int64_t* to) const = 0;
  /// Writes the coordinates of the particles at these places.
  virtual void gather_unwrapped(const UnwrappedAlong& along, const Index* places, Index count, double* to) const = 0;
  virtual void copy(const float* from, float* to, Index count) const = 0;
  virtual void copy(const double* from, double* to, Index count) const = 0;
};

}  // namespace mesogen::exec
