#pragma once

#include <limits>

#include "mesogen/exec/device_memory.hpp"

namespace mesogen::exec {

/// Memory of a device that is played by the host, for tests where there is no device: a second buffer of each array.
/// What is out of date on either side is filled with bytes 0xFF, which are NaN as a floating-point number and -1 as an
/// index.
class MESOGEN_EXPORT EmulatedMemory : public DeviceMemory {
 public:
  /// As if the device had so much memory, bytes.
  explicit EmulatedMemory(std::size_t total = std::numeric_limits<std::size_t>::max());

  void to_device(void* device, const void* host, std::size_t bytes) override;
  void to_host(void* host, const void* device, std::size_t bytes) override;
  void copy(void* to, const void* from, std::size_t bytes) override;
  void zero(void* device, std::size_t bytes) override;
  /// Copies only when it is waited for: who changes bytes that are on their way gets them changed.
  [[nodiscard]] std::unique_ptr<Fetch> make_fetch() override;
  void mark_stale(void* place, std::size_t bytes) override;

 protected:
  [[nodiscard]] Room room() const override;
  [[nodiscard]] void* take(std::size_t bytes) override;
  void give_back(void* place) noexcept override;

 private:
  std::size_t total_;
};

}  // namespace mesogen::exec
