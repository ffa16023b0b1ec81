#pragma once

#include "plugin/registry.hpp"

namespace mesogen::test {

/// The plugins of this build, loaded as the command loads them.
const PluginRegistry& built_plugins();

}  // namespace mesogen::test
