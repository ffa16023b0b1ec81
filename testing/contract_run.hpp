#pragma once

#include <functional>
#include <string>
#include <vector>

#include "contract_watch.hpp"
#include "mesogen/testing/plugin_harness.hpp"
#include "plugin/registry.hpp"

namespace mesogen::testing {

/// Numbers by name, to be compared.
using Numbers = std::map<std::string, std::vector<double>>;

/// The checks of one plugin, as they come.
class ContractRun {
 public:
  /// All of these must outlive it.
  ContractRun(PluginKind kind, std::string name, const ContractSettings& settings, const ContractWatch& watch);

  /// `action` throws Error, or returns what is wrong; an empty text if nothing is.
  void check(const std::string& what, const std::function<std::string()>& action);
  void note(const std::string& text);
  /// Does something that no check is about, unless the plugin ended the process with it before.
  void attempt(const std::string& what, const std::function<void()>& action);

  /// The plugin in a scene, with the values of its parameters.
  [[nodiscard]] PluginHarness harness(TestScene scene = {}) const;
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const PluginRegistry& registry() const { return registry_; }
  [[nodiscard]] const std::vector<ContractCheck>& checks() const { return checks_; }

  void check_descriptor();
  void check_parameters(const ParameterList& list);

 private:
  PluginKind kind_;
  std::string name_;
  const ContractSettings& settings_;
  const PluginRegistry& registry_;
  const ContractWatch& watch_;
  std::string keys_;
  std::vector<ContractCheck> checks_;
};

void check_kernel(ContractRun& run);
void check_boundary(ContractRun& run);
void check_shape(ContractRun& run);
void check_initial(ContractRun& run);
void check_physics(ContractRun& run);
void check_observer(ContractRun& run);

/// The same as `action` gives with so many threads.
Numbers with_threads(int threads, const std::function<Numbers()>& action);
/// Where two results differ in a bit, in words; empty if nowhere. Numbers that are none are the same.
std::string difference(const Numbers& one, const Numbers& other);
/// Where they differ by more than so much of the largest number of their kind.
std::string difference(const Numbers& one, const Numbers& other, double tolerance);

}  // namespace mesogen::testing
