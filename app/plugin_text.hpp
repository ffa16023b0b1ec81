#pragma once

#include <string>

#include "plugin_facts.hpp"

namespace mesogen::app {

/// A plugin for people: what `plugin info` prints.
std::string info_text(const PluginFacts& facts);

}  // namespace mesogen::app
