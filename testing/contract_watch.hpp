#pragma once

#include <functional>
#include <set>
#include <string>

#include "mesogen/testing/contract.hpp"

namespace mesogen::testing {

/// Who is told how the checks of a plugin come along, and which of them are left out because they were done before.
struct ContractWatch {
  std::function<void(const std::string& what)> begun = [](const std::string&) {};
  std::function<void(const ContractCheck& check)> ended = [](const ContractCheck&) {};
  std::set<std::string> done;
};

std::vector<ContractCheck> check_contract(PluginKind kind, std::string_view name, const ContractSettings& settings,
                                          const ContractWatch& watch);

}  // namespace mesogen::testing
