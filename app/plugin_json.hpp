#pragma once

#include <string>
#include <vector>

#include "plugin_facts.hpp"

namespace mesogen::app {

/// For programs: what `plugin list --json` prints, and `plugin info --json`.
std::string list_json(const PluginRegistry& registry);
std::string info_json(const std::vector<PluginFacts>& plugins);

}  // namespace mesogen::app
