#pragma once

#include <string>

#include "mesogen/plugin/parameters.hpp"
#include "mesogen/testing/contract.hpp"
#include "plugin/registry.hpp"

namespace mesogen::testing {

/// The keys of the plugin's section, as TOML: its required ones and those of the settings. Throws Error(bad_case) if a
/// key is unknown or a value is not one that the plugin takes, naming it as it stands on the command line.
std::string keys_of(PluginKind kind, const std::string& name, const ParameterList& list, const PluginRegistry& registry,
                    const ContractSettings& settings);

/// Throws Error(bad_case), naming them, if the plugin makes no scene for want of constants that others publish.
void require_constants(PluginKind kind, const std::string& name, const std::string& keys,
                       const PluginRegistry& registry, const ContractSettings& settings);

}  // namespace mesogen::testing
