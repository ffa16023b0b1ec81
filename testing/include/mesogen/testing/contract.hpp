#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "mesogen/export.hpp"
#include "mesogen/plugin/descriptor.hpp"

namespace mesogen::testing {

/// One rule that every plugin of a kind must obey, and whether the tested plugin obeys it.
struct ContractCheck {
  enum class Outcome { held, broken, note };
  std::string what;
  Outcome outcome = Outcome::held;
  std::string problem;  ///< of a broken rule: what is wrong, and how to mend it
};

/// What the checks cannot know by themselves.
struct ContractSettings {
  /// Values of the plugin's parameters, by key. A required parameter that is not given here gets a value of its range:
  /// a number the middle, or 1 beyond its only bound, or 1; a choice the first; a list its smallest size.
  std::map<std::string, std::string> values;
  /// Constants that other plugins of a case would publish, by name.
  std::map<std::string, double> constants;
  /// Folders of plugins, separated by colons, in addition to the usual ones.
  std::string folders;
};

/// Loads the plugin by the real loader and runs it in scenes with seeded fields. Does not throw for faults of the
/// plugin: the result reports them. Throws Error if there is no plugin of this name, or if the settings do not fit it:
/// an unknown key, a value that the plugin refuses, or a constant that the plugin needs and nobody gives.
MESOGEN_EXPORT std::vector<ContractCheck> check_contract(PluginKind kind, std::string_view name,
                                                         const ContractSettings& settings = {});

/// The same in a separate process. A plugin that crashes, ends the process or takes longer than `seconds` for one check
/// breaks only that check; the other checks continue in another process. Call it before anything has run in parallel in
/// this process, because a new process does not have its threads.
MESOGEN_EXPORT std::vector<ContractCheck> check_contract_apart(PluginKind kind, std::string_view name,
                                                               const ContractSettings& settings, unsigned seconds);

}  // namespace mesogen::testing
