#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <new>

namespace mesogen::exec {

/// Memory of the host for an array, in pages of 2 MiB if it is large and the system has them: loops that stream through
/// large arrays then take some per cent less time. Throws std::bad_alloc. For release_large().
inline void* allocate_large(std::size_t bytes) {
  constexpr std::size_t page = std::size_t{2} << 20;
  constexpr std::size_t cache_line = 64;
  const bool large = bytes >= page;
  void* memory = nullptr;
  if (posix_memalign(&memory, large ? page : cache_line, bytes) != 0) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
  // Where the system declines, pages are small.
  if (large) (void)madvise(memory, bytes / page * page, MADV_HUGEPAGE);
#endif
  return memory;
}
inline void release_large(void* memory) noexcept { std::free(memory); }

/// The same for a std::vector.
template <class T>
struct LargePages {
  using value_type = T;
  LargePages() = default;
  template <class U>
  LargePages(const LargePages<U>& /*other*/) {}  // NOLINT: allocators convert
  T* allocate(std::size_t count) { return static_cast<T*>(allocate_large(count * sizeof(T))); }
  void deallocate(T* memory, std::size_t /*count*/) noexcept { release_large(memory); }
  bool operator==(const LargePages& /*other*/) const { return true; }
};

}  // namespace mesogen::exec
