#pragma once

#include <string_view>

#include "plugin/registry.hpp"

namespace mesogen::testing {

/// The plugins of these folders (separated by colons) and of the usual places. Folders are searched once a process.
const PluginRegistry& registry_of(std::string_view folders);

}  // namespace mesogen::testing
