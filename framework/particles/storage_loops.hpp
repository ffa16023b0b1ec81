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

  /// Place n takes what stood at order[n]. `scratch` has room for `count` values.
  virtual void permute(float* values, const Index* order, Index count, float* scratch) const = 0;
  virtual void permute(double* values, const Index* order, Index count, double* scratch) const = 0;
  virtual void permute(std::int32_t* values, const Index* order, Index count, std::int32_t* scratch) const = 0;
  virtual void permute(std::int64_t* values, const Index* order, Index count, std::int64_t* scratch) const = 0;
  /// Writes the coordinates of the particles at these places.
  virtual void gather_unwrapped(const UnwrappedAlong& along, const Index* places, Index count, double* to) const = 0;
  virtual void copy(const double* from, double* to, Index count) const = 0;
};

}  // namespace mesogen::exec
