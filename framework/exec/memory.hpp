#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "mesogen/export.hpp"

namespace mesogen::exec {

/// Where arrays lie: on the host, or where host and device both reach them.
class MESOGEN_EXPORT Memory {
 public:
  Memory() = default;
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
  virtual ~Memory();

  /// Throws std::bad_alloc where there is no room.
  [[nodiscard]] virtual void* allocate(std::size_t bytes) = 0;
  virtual void release(void* place) noexcept = 0;

  static Memory& host();
};

/// Lets a std::vector lie in such memory. A vector stays where it was made: assignment copies its elements there.
template <class T>
class Allocator {
 public:
  using value_type = T;
  using propagate_on_container_copy_assignment = std::false_type;
  using propagate_on_container_move_assignment = std::false_type;
  using propagate_on_container_swap = std::true_type;
  using is_always_equal = std::false_type;

  Allocator() noexcept : memory_(&Memory::host()) {}
  Allocator(Memory& memory) noexcept : memory_(&memory) {}  // NOLINT: a memory is what a vector is made with
  template <class U>
  Allocator(const Allocator<U>& other) noexcept : memory_(&other.memory()) {}  // NOLINT: as the standard asks

  [[nodiscard]] T* allocate(std::size_t count) { return static_cast<T*>(memory_->allocate(count * sizeof(T))); }
  void deallocate(T* place, std::size_t) noexcept { memory_->release(place); }
  [[nodiscard]] Memory& memory() const noexcept { return *memory_; }

  template <class U>
  bool operator==(const Allocator<U>& other) const noexcept {
    return memory_ == &other.memory();
  }

 private:
  Memory* memory_;
};

template <class T>
using Array = std::vector<T, Allocator<T>>;

/// One array per axis.
template <class T>
std::array<Array<T>, 3> three(Memory& memory) {
  return {Array<T>(memory), Array<T>(memory), Array<T>(memory)};
}

}  // namespace mesogen::exec
