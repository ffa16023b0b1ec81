#pragma once

#include <cstdint>

#include "exec/backend.hpp"
#include "mesogen/fields/field_view.hpp"

namespace mesogen::exec {

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
  virtual void copy(const double* from, double* to, Index count) const = 0;
};

}  // namespace mesogen::exec
