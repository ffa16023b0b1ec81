#include "exec/emulated_memory.hpp"

#include <cstring>
#include <new>

namespace mesogen::exec {

EmulatedMemory::EmulatedMemory(std::size_t total) : DeviceMemory("the emulated device"), total_(total) {}

void EmulatedMemory::to_device(void* device, const void* host, std::size_t bytes) { std::memcpy(device, host, bytes); }
void EmulatedMemory::to_host(void* host, const void* device, std::size_t bytes) { std::memcpy(host, device, bytes); }
void EmulatedMemory::copy(void* to, const void* from, std::size_t bytes) { std::memcpy(to, from, bytes); }
void EmulatedMemory::zero(void* device, std::size_t bytes) { std::memset(device, 0, bytes); }
void EmulatedMemory::mark_stale(void* place, std::size_t bytes) { std::memset(place, 0xFF, bytes); }

EmulatedMemory::Room EmulatedMemory::room() const { return {total_ - held(), total_}; }
void* EmulatedMemory::take(std::size_t bytes) { return ::operator new(bytes, std::nothrow); }
void EmulatedMemory::give_back(void* place) noexcept { ::operator delete(place); }

}  // namespace mesogen::exec
