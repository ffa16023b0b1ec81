#include "exec/memory.hpp"

#include <new>

namespace mesogen::exec {

namespace {

class HostMemory final : public Memory {
 public:
  [[nodiscard]] void* allocate(std::size_t bytes) override { return ::operator new(bytes); }
  void release(void* place) noexcept override { ::operator delete(place); }
};

}  // namespace

Memory::~Memory() = default;

Memory& Memory::host() {
  // Never destroyed: vectors may outlive everything else.
  static auto* const memory = new HostMemory;
  return *memory;
}

}  // namespace mesogen::exec
