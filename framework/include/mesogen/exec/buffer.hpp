#pragma once

#include <cstddef>

#include "mesogen/exec/device_memory.hpp"
#include "mesogen/export.hpp"

namespace mesogen::exec {

/// What an access to an array is for.
enum class Access {
  read,
  write,       ///< all values are replaced: the old ones are not brought there
  read_write,  ///< also where only some are replaced
};

/// Whose code accesses it: the host's, or that of the backend's device.
enum class Side { host, device };

/// The bytes of an Array, on the host and on a device, and on which side they are up to date. Without a device there is
/// one buffer for both sides, and an access costs nothing.
class MESOGEN_EXPORT Buffer {
 public:
  /// `memory`: of the device; null where there is none.
  explicit Buffer(DeviceMemory* memory) noexcept : memory_(memory) {}
  Buffer(const Buffer& other);
  Buffer(Buffer&& other) noexcept : memory_(other.memory_) { swap(other); }
  /// Copies the bytes; this buffer stays in its own memory. (A move takes the memory of the other one along.)
  Buffer& operator=(const Buffer& other);
  Buffer& operator=(Buffer&& other) noexcept {
    swap(other);
    return *this;
  }
  ~Buffer();

  void swap(Buffer& other) noexcept;

  [[nodiscard]] std::size_t bytes() const { return bytes_; }
  [[nodiscard]] DeviceMemory* memory() const { return memory_; }

  /// Keeps the bytes there are; new ones are 0.
  void resize(std::size_t bytes);
  /// What it held is lost.
  void resize_for_overwrite(std::size_t bytes);
  /// Bytes from `first` on become 0.
  void zero(std::size_t first);
  /// Copies bytes of another buffer to `to`, on the side where those are up to date.
  void copy(const Buffer& from, std::size_t first, std::size_t bytes, std::size_t to);

  /// Are the newest bytes there, so that reading them copies nothing?
  [[nodiscard]] bool is_on(Side side) const {
    return memory_ == nullptr || (side == Side::host ? host_valid_ : device_valid_);
  }
  [[nodiscard]] const void* read(Side side) const {
    if (memory_ != nullptr) bring_to(side);
    return memory_ == nullptr || side == Side::host ? host_ : device_;
  }
  [[nodiscard]] void* access(Side side, Access access) {
    if (memory_ == nullptr) return host_;
    return access_in_turn(side, access);
  }

 private:
  void bring_to(Side side) const;
  void make_room(Side side) const;
  [[nodiscard]] void* access_in_turn(Side side, Access access);
  void release() noexcept;

  DeviceMemory* memory_;
  // Reading brings bytes to the side that reads.
  mutable void* host_ = nullptr;    // each made when its side is first accessed
  mutable void* device_ = nullptr;  // never made where there is no device
  mutable bool host_valid_ = true;
  mutable bool device_valid_ = true;
  std::size_t bytes_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace mesogen::exec
