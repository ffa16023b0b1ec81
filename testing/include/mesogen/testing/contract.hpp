#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "mesogen/export.hpp"
#include "mesogen/plugin/descriptor.hpp"

namespace mesogen::testing {

/// One thing that every plugin of a kind must hold.
struct ContractCheck {
  enum class Outcome { held, broken, note };
  std::string what;
  Outcome outcome = Outcome::held;
  std::string problem;  ///< of a broken one: what, and how to mend it
};

/// What the checks cannot know by themselves.
struct ContractSettings {
  /// Values of the plugin's parameters, by key. One that is required and not here is taken from its range: the middle,
  /// or 1 beyond the bound that it has, or 1; the first of its choices; as many numbers as its smallest size.
  std::map<std::string, std::string> values;
  /// What other plugins of a case would publish, by name.
  std::map<std::string, double> constants;
  /// Folders of plugins, separated by colons, beside the usual ones.
  std::string folders;
};

/// Loads the plugin by the real loader and runs it in scenes with seeded fields. Never throws for what is wrong with
/// the plugin, only Error if there is none of this name, or if the settings do not fit it: a key that it does not know,
/// a value that it does not take, a constant that it needs and nobody gives.
MESOGEN_EXPORT std::vector<ContractCheck> check_contract(PluginKind kind, std::string_view name,
                                                         const ContractSettings& settings = {});

/// The same in a process of its own, so that a plugin that crashes, ends the process or takes longer than so many
/// seconds over one check breaks that check alone: the others go on in another process. To be called before anything
/// has run in parallel in this one, since its threads are not in the other.
MESOGEN_EXPORT std::vector<ContractCheck> check_contract_apart(PluginKind kind, std::string_view name,
                                                               const ContractSettings& settings, unsigned seconds);

}  // namespace mesogen::testing
