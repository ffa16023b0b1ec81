#pragma once

#include <vector>

#include "json.hpp"
#include "plugin_facts.hpp"

namespace mesogen::app {

/// JSON Schema of a case: the framework's keys, and those of these plugins. Draft 7, which the TOML extensions of
/// editors understand (taplo).
Json case_schema(const std::vector<PluginFacts>& plugins);

}  // namespace mesogen::app
