#pragma once

#include <string>
#include <vector>

#include "plugin_facts.hpp"

namespace mesogen::app {

/// All keys of a case and all that these plugins declare, as a page of Markdown. The same on every machine: no files,
/// no instruction sets.
std::string reference_text(const std::vector<PluginFacts>& plugins);

}  // namespace mesogen::app
