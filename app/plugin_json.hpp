#pragma once

#include "json.hpp"
#include "plugin_facts.hpp"

namespace mesogen::app {

/// A plugin for programs: what `plugin info --json` prints of each.
Json info_json(const PluginFacts& facts);

}  // namespace mesogen::app
