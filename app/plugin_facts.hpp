#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "case/declared_keys.hpp"
#include "mesogen/sph/kernel_shape.hpp"
#include "plugin/registry.hpp"

namespace mesogen::app {

/// All that a plugin says of itself, gathered once for every way of showing it. Nothing here refers to the plugin's
/// own objects.
struct PluginFacts {
  PluginKind kind{};
  std::string name;
  std::string version;
  std::string summary;
  std::int32_t abi = 0;
  std::string build_tag;
  std::string file;
  std::string instruction_set;
  std::vector<int> dimensions;  ///< in which it can be used
  bool any_dimension = false;   ///< it is limited by what Mesogen is built for alone
  bool cuda = false;            ///< physics: has it a library for CUDA as well?
  std::vector<DeclaredKey> keys;

  std::optional<sph::KernelShape> shape;  ///< kernels

  std::vector<FieldDeclaration> fields;  ///< physics, with default parameters; of initial conditions, those they set
  std::vector<Pass> passes;              ///< without their bodies
  Transport transport;                   ///< how it moves the particles, if it does
  std::vector<std::string> constants;    ///< that it publishes by name

  std::vector<std::string> reads;  ///< observers
  std::vector<std::string> reads_if_present;
  std::map<std::string, std::string> reads_otherwise;  ///< in place of which of those
  std::vector<Quantity> quantities;
  bool follows = false;  ///< looks after every step

  /// Why fields and passes, or quantities, cannot be told without a case: what the plugin answered.
  std::string not_described;
};

/// Makes one object of the plugin and asks it. Throws an Error if that, or the declaration of parameters, fails.
PluginFacts plugin_facts(const PluginRegistry& registry, const LoadedPlugin& plugin);

/// The facts of every plugin, sorted by kind and name; tells on stderr of those that cannot be asked.
std::vector<PluginFacts> all_plugin_facts(const PluginRegistry& registry);

/// Where a plugin's parameters stand in a case: "[physics.NAME]".
std::string_view place_in_case(PluginKind kind);
std::string_view to_string(Phase phase);
/// "advanced with order_tensor_rate"; empty for a field that only passes write.
std::string advance_text(const FieldDeclaration& field);
/// "one number", "rows of 4 numbers"
std::string form_text(const Quantity& quantity);

}  // namespace mesogen::app
