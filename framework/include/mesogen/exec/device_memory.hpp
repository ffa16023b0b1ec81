#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>

#include "mesogen/export.hpp"

namespace mesogen::exec {

class Fetch;  // exec/fetch.hpp

/// The memory of a device, apart from the host's: how room is taken there, and how bytes get there and back. All that
/// the device was asked for before a copy is done before it. One for the process.
class MESOGEN_EXPORT DeviceMemory {
 public:
  /// `device`: its name, for messages.
  explicit DeviceMemory(std::string device) : device_(std::move(device)) {}
  DeviceMemory(const DeviceMemory&) = delete;
  DeviceMemory& operator=(const DeviceMemory&) = delete;
  virtual ~DeviceMemory();

  /// The largest part of the free memory that one allocation may take. A device whose memory is full hangs or fails
  /// where nobody expects it.
  static constexpr double usable = 0.9;

  /// Throws Error(run_failed) where `bytes` are more than `usable` of what is free.
  [[nodiscard]] void* allocate(std::size_t bytes);
  void release(void* place, std::size_t bytes) noexcept;
  /// Bytes allocated now.
  [[nodiscard]] std::size_t held() const { return held_; }

  virtual void to_device(void* device, const void* host, std::size_t bytes) = 0;
  /// Waits for the device. Throws Error(run_failed) if something that it was asked for failed.
  virtual void to_host(void* host, const void* device, std::size_t bytes) = 0;
  /// From one place on the device to another.
  virtual void copy(void* to, const void* from, std::size_t bytes) = 0;
  virtual void zero(void* device, std::size_t bytes) = 0;
  /// A way by which bytes get to the host while the device goes on with its work.
  [[nodiscard]] virtual std::unique_ptr<Fetch> make_fetch() = 0;
  /// Called with bytes on either side that are out of date. An emulated device overwrites them, so that a reader who
  /// forgot to ask for the newest values cannot miss it.
  virtual void mark_stale(void* /*place*/, std::size_t /*bytes*/) {}

 protected:
  struct Room {
    std::size_t free, total;  // bytes
  };
  [[nodiscard]] virtual Room room() const = 0;
  /// Null if the device has no room.
  [[nodiscard]] virtual void* take(std::size_t bytes) = 0;
  virtual void give_back(void* place) noexcept = 0;

 private:
  std::string device_;
  std::size_t held_ = 0;
};

}  // namespace mesogen::exec
