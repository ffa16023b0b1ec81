#pragma once

#include <cstddef>

#include "exec/emulated_memory.hpp"

namespace mesogen::test {

/// An emulated device's memory that counts the bytes which cross, either way.
class CountingMemory final : public exec::EmulatedMemory {
 public:
  void to_device(void* device, const void* host, std::size_t bytes) override {
    copied += bytes;
    EmulatedMemory::to_device(device, host, bytes);
  }
  void to_host(void* host, const void* device, std::size_t bytes) override {
    copied += bytes;
    EmulatedMemory::to_host(host, device, bytes);
  }
  std::size_t copied = 0;
};

}  // namespace mesogen::test
