#pragma once

#include <cstddef>
#include <cstdint>

#include "mesogen/export.hpp"
#include "mesogen/particles/dimensions.hpp"
#include "mesogen/particles/rank.hpp"

namespace mesogen {

class Kernel;
class Boundary;
class Physics;
class Observer;
class Initial;

enum class PluginKind : std::int32_t { kernel = 1, boundary = 2, physics = 3, observer = 4, initial = 5 };

/// Raised whenever a public interface changes.
#define MESOGEN_ABI 8
inline constexpr std::int32_t abi_number = MESOGEN_ABI;
inline constexpr std::uint64_t descriptor_magic = 0x4e45474f53454d31ULL;  // "1MESOGEN" in memory

/// Compiler and standard library that a plugin was built with: objects cross the boundary, so these must agree.
#define MESOGEN_STRINGIFY_(x) #x
#define MESOGEN_STRINGIFY(x) MESOGEN_STRINGIFY_(x)
#if defined(__clang__)
#define MESOGEN_COMPILER "clang"
#else
#define MESOGEN_COMPILER "gcc"
#endif
#define MESOGEN_BUILD_TAG \
  MESOGEN_COMPILER "-itanium" MESOGEN_STRINGIFY(__GXX_ABI_VERSION) "-cxx11abi" MESOGEN_STRINGIFY(_GLIBCXX_USE_CXX11_ABI)

/// The one thing a plugin library exports, under the name `mesogen_plugin`. Plain data, checked field by field before
/// any C++ type behind it is touched.
struct PluginDescriptor {
  std::uint64_t magic;
  std::int32_t abi;
  std::uint32_t size;  ///< of this struct
  const char* build_tag;
  PluginKind kind;
  const char* name;
  const char* version;
  const char* summary;
  /// Those of AllDimensions for which the plugin has a form.
  DimensionSet dimensions;
  /// A new object of the kind's class, as a pointer to that class (Kernel*, Boundary*, Physics*, Observer* or
  /// Initial*); nullptr if it has no form for this precision and dimension.
  void* (*create)(Precision precision, int dimension);
};

}  // namespace mesogen

/// Exports the address of a descriptor from a library, under the name that Mesogen asks Boost.DLL for.
#define MESOGEN_EXPORT_DESCRIPTOR(DESCRIPTOR)       \
  extern "C" {                                      \
  MESOGEN_EXPORT extern const void* mesogen_plugin; \
  const void* mesogen_plugin = &(DESCRIPTOR);       \
  }
