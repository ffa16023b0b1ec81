#pragma once

#include <filesystem>
#include <string>

#include "mesogen/plugin/descriptor.hpp"

namespace mesogen::plugin {

/// A loaded library's descriptor, or why it was refused.
struct LoadResult {
  const PluginDescriptor* descriptor = nullptr;
  std::string problem;
};

/// Loads a library and checks its descriptor. The library stays loaded until the process ends, whatever happens to
/// objects that it made. `file` is absolute.
LoadResult load(const std::filesystem::path& file);

/// What is wrong with a descriptor, in words; empty if nothing. Touches nothing behind the first field that is wrong.
MESOGEN_EXPORT std::string descriptor_problem(const PluginDescriptor& descriptor);

}  // namespace mesogen::plugin
