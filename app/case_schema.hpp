#pragma once

#include <string>
#include <vector>

#include "plugin_facts.hpp"

namespace mesogen::app {

/// JSON Schema of a case: the framework's keys, and those of these plugins. Draft 7, which the TOML extensions of
/// editors understand (taplo).
std::string case_schema(const std::vector<PluginFacts>& plugins);

}  // namespace mesogen::app
