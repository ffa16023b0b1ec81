#pragma once

#include <cstddef>
#include <cstdint>

#include "mesogen/diagnostics/build_tag.hpp"
#include "mesogen/export.hpp"
#include "mesogen/fields/dimensions.hpp"
#include "mesogen/fields/rank.hpp"

namespace mesogen {

class Kernel;
class Boundary;
class Physics;
class Observer;
class Initial;
class Shape;

enum class PluginKind : std::int32_t { kernel = 1, boundary = 2, physics = 3, observer = 4, initial = 5, shape = 6 };

/// Raised whenever a public interface changes.
#define MESOGEN_ABI 12
inline constexpr std::int32_t abi_number = MESOGEN_ABI;
inline constexpr std::uint64_t descriptor_magic = 0x4e45474f53454d31ULL;  // "1MESOGEN" in memory

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
  /// A new object of the kind's class, as a pointer to that class (Kernel*, Boundary*, Physics*, Observer*,
  /// Initial* or Shape*); nullptr if it has no form for this precision and dimension.
  void* (*create)(Precision precision, int dimension);
};

}  // namespace mesogen

/// Exports the address of a descriptor from a library, under the name that Mesogen asks Boost.DLL for.
#define MESOGEN_EXPORT_DESCRIPTOR(DESCRIPTOR)       \
  extern "C" {                                      \
  MESOGEN_EXPORT extern const void* mesogen_plugin; \
  const void* mesogen_plugin = &(DESCRIPTOR);       \
  }
