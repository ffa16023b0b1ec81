#include "exec/emulated_memory.hpp"

#include <cstring>
#include <new>
#include <vector>

#include "exec/fetch.hpp"

namespace mesogen::exec {

namespace {

class EmulatedFetch final : public Fetch {
 public:
  void begin(const void* device, std::size_t bytes) override {
    device_ = device;
    host_.assign(bytes, std::byte{0xFF});
  }
  [[nodiscard]] const void* wait() override {
    if (!host_.empty()) std::memcpy(host_.data(), device_, host_.size());
    return host_.data();
  }

 private:
  const void* device_ = nullptr;
  std::vector<std::byte> host_;
};

}  // namespace

EmulatedMemory::EmulatedMemory(std::size_t total) : DeviceMemory("the emulated device"), total_(total) {}

void EmulatedMemory::to_device(void* device, const void* host, std::size_t bytes) { std::memcpy(device, host, bytes); }
void EmulatedMemory::to_host(void* host, const void* device, std::size_t bytes) { std::memcpy(host, device, bytes); }
void EmulatedMemory::copy(void* to, const void* from, std::size_t bytes) { std::memcpy(to, from, bytes); }
void EmulatedMemory::zero(void* device, std::size_t bytes) { std::memset(device, 0, bytes); }
std::unique_ptr<Fetch> EmulatedMemory::make_fetch() { return std::make_unique<EmulatedFetch>(); }
void EmulatedMemory::mark_stale(void* place, std::size_t bytes) { std::memset(place, 0xFF, bytes); }

EmulatedMemory::Room EmulatedMemory::room() const { return {total_ - held(), total_}; }
void* EmulatedMemory::take(std::size_t bytes) { return ::operator new(bytes, std::nothrow); }
void EmulatedMemory::give_back(void* place) noexcept { ::operator delete(place); }

}  // namespace mesogen::exec
