#pragma once

#include <string>

#include "plugin/registry.hpp"

namespace mesogen::app {

/// All that a plugin says of itself: kind, version, file, parameters, and by kind its form, fields and passes, or
/// quantities.
std::string info_text(const PluginRegistry& registry, const LoadedPlugin& plugin);

}  // namespace mesogen::app
