#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "mesogen/export.hpp"

namespace mesogen {

/// Index of a particle in storage order. Those of the fluid come first, [0, count); those of walls and ghosts follow.
using Index = std::int32_t;

/// A field as a pass sees it: one contiguous array a component ("structure of arrays").
/// Trivially copyable, so a functor that holds views can be sent to a device.
template <class T>
struct FieldView {
  T* base = nullptr;
  std::ptrdiff_t stride = 0;  ///< elements between two components

  MESOGEN_HOST_DEVICE T& operator()(Index particle) const { return base[particle]; }
  MESOGEN_HOST_DEVICE T& operator()(int component, Index particle) const { return base[component * stride + particle]; }
  MESOGEN_HOST_DEVICE T* component(int c) const { return base + c * stride; }
  MESOGEN_HOST_DEVICE explicit operator bool() const { return base != nullptr; }
  /// What is written can be read.
  template <class U>
  requires(std::is_same_v<U, const T> && !std::is_const_v<T>) MESOGEN_HOST_DEVICE operator FieldView<U>() const {
    return {base, stride};
  }  // NOLINT: nothing is lost
};

}  // namespace mesogen
