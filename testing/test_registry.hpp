#pragma once

#include <string_view>

#include "plugin/registry.hpp"

namespace mesogen::testing {

/// The plugins of these folders (separated by colons) and of the usual places. A plugin of these
/// folders goes before its twin elsewhere: one that was installed does not stand in the way of the one under test.
/// Folders are searched once a process.
const PluginRegistry& registry_of(std::string_view folders);

}  // namespace mesogen::testing
