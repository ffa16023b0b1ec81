#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <ranges>
#include <span>
#include <type_traits>

#include "mesogen/exec/buffer.hpp"

namespace mesogen::exec {

/// Numbers that code of the host and of a device take turns to work on. It knows on which side the newest values lie;
/// who asks for one side gets them there, after waiting for the device if need be:
///
///     loops.move(array.device(Access::read_write), ...);
///     for (const double x : array.host()) ...
///
/// A pointer holds until the other side writes or the size changes: ask again then, and never per element. Not for
/// several threads at a time: ask before the loop.
template <class T>
class Array {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  /// `memory`: of the device; null where there is none, and host and device are the same.
  explicit Array(DeviceMemory* memory = nullptr) noexcept : buffer_(memory) {}

  [[nodiscard]] std::size_t size() const { return buffer_.bytes() / sizeof(T); }
  [[nodiscard]] bool empty() const { return buffer_.bytes() == 0; }
  /// Keeps the values there are; new ones are 0.
  void resize(std::size_t size) { buffer_.resize(size * sizeof(T)); }
  /// The values are lost, and undefined until they are written.
  void resize_for_overwrite(std::size_t size) { buffer_.resize_for_overwrite(size * sizeof(T)); }
  void clear() { resize_for_overwrite(0); }
  /// Values from this place on become 0.
  void zero(std::size_t first) { buffer_.zero(first * sizeof(T)); }

  template <std::ranges::sized_range Values>
  void assign(const Values& values) {
    resize_for_overwrite(std::ranges::size(values));
    std::ranges::copy(values, host(Access::write).begin());
  }
  /// Copies values of another array to place `to`, on the side where those are.
  void copy(const Array& from, std::size_t first, std::size_t count, std::size_t to) {
    buffer_.copy(from.buffer_, first * sizeof(T), count * sizeof(T), to * sizeof(T));
  }
  void swap(Array& other) noexcept { buffer_.swap(other.buffer_); }

  [[nodiscard]] std::span<const T> host() const { return {on(Side::host), size()}; }
  [[nodiscard]] std::span<T> host(Access access) { return {on(Side::host, access), size()}; }
  [[nodiscard]] const T* device() const { return on(Side::device); }
  [[nodiscard]] T* device(Access access) { return on(Side::device, access); }
  /// Are the newest values there, so that reading them copies nothing?
  [[nodiscard]] bool is_on(Side side) const { return buffer_.is_on(side); }
  /// Where the side is chosen at run time.
  [[nodiscard]] const T* on(Side side) const { return static_cast<const T*>(buffer_.read(side)); }
  [[nodiscard]] T* on(Side side, Access access) { return static_cast<T*>(buffer_.access(side, access)); }

 private:
  Buffer buffer_;
};

/// One array per axis.
template <class T>
using AxisArrays = std::array<Array<T>, 3>;

template <class T>
AxisArrays<T> axis_arrays(DeviceMemory* memory) {
  return {Array<T>(memory), Array<T>(memory), Array<T>(memory)};
}

/// Pointers to each, to read.
template <class T>
std::array<const T*, 3> pointers(const AxisArrays<T>& arrays, Side side) {
  return {arrays[0].on(side), arrays[1].on(side), arrays[2].on(side)};
}

}  // namespace mesogen::exec
