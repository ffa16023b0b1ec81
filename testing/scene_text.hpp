#pragma once

#include <string>
#include <string_view>

#include "mesogen/testing/plugin_harness.hpp"
#include "plugin/registry.hpp"

namespace mesogen::testing {

/// Name in the case of the plugin that a harness tests: [physics.tested], [observers.tested], [solids.tested].
inline constexpr std::string_view tested_instance = "tested";

/// The case that puts this plugin into this scene.
std::string scene_text(PluginKind kind, std::string_view name, std::string_view keys, const TestScene& scene,
                       const PluginRegistry& registry);

}  // namespace mesogen::testing
