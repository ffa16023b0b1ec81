#pragma once

#include <cstddef>

#include "exec/emulated_memory.hpp"

namespace mesogen::test {

/// An emulated device's memory that counts the bytes which cross while the host waits for them. It may be full.
class CountingMemory final : public exec::EmulatedMemory {
 public:
  void to_device(void* device, const void* host, std::size_t bytes) override {
    copied += bytes;
    EmulatedMemory::to_device(device, host, bytes);
  }
  void to_host(void* host, const void* device, std::size_t bytes) override {
    copied += bytes;
    brought += bytes;
    EmulatedMemory::to_host(host, device, bytes);
  }
  std::size_t copied = 0;   ///< either way
  std::size_t brought = 0;  ///< to the host
  bool full = false;

 protected:
  [[nodiscard]] void* take(std::size_t bytes) override { return full ? nullptr : EmulatedMemory::take(bytes); }
};

}  // namespace mesogen::test
