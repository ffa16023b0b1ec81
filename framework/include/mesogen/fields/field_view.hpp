#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "mesogen/export.hpp"

namespace mesogen {

/// Index of a particle in storage. Particles of the fluid have [0, count); those of walls and ghosts follow.
using Index = std::int32_t;

/// A field as a pass sees it: one contiguous array per component ("structure of arrays"). Trivially copyable, so that a
/// functor that holds views can be copied to a device.
template <class T>
struct FieldView {
  T* base = nullptr;
  std::ptrdiff_t stride = 0;  ///< from one component to the next, in elements

  MESOGEN_HOST_DEVICE T& operator()(Index particle) const { return base[particle]; }
  MESOGEN_HOST_DEVICE T& operator()(int component, Index particle) const { return base[component * stride + particle]; }
  MESOGEN_HOST_DEVICE T* component(int c) const { return base + c * stride; }
  MESOGEN_HOST_DEVICE explicit operator bool() const { return base != nullptr; }
  /// Converts to a read-only view: a pass may read what it writes.
  template <class U>
  requires(std::is_same_v<U, const T> && !std::is_const_v<T>) MESOGEN_HOST_DEVICE operator FieldView<U>() const {
    return {base, stride};
  }  // NOLINT: nothing is lost
};

}  // namespace mesogen
