#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "mesogen/plugin/descriptor.hpp"

/// The keys that the framework itself reads, bound to a case: for reading, for messages and for writing it back.
namespace mesogen::case_keys {

/// A section of a case, or a part of one that chooses a plugin.
struct Section {
  /// "domain", "domain.boundary"; empty: keys outside any section; "NAME": a section called after its plugin.
  std::string name;
  std::string doc;
  bool required = false;
  bool instances = false;                           ///< holds tables named by the user, such as [physics.flow]
  std::optional<PluginKind> plugin = std::nullopt;  ///< it chooses one of this kind, whose parameters are keys here too
  std::string chooser = "type";                     ///< the key that names the plugin
  /// Is it called after its plugin?
  [[nodiscard]] bool plugin_named() const { return plugin == PluginKind::initial; }
};
/// All of them, in the order in which a case is best read.
const std::vector<Section>& sections();

ParameterList title(std::string& title);
ParameterList units(Units& units);
ParameterList domain(Case::Domain& domain);
ParameterList particles(Case::Particles& particles);
ParameterList kernel(double& smoothing_length_ratio, std::string& laplacian);
ParameterList time(Case::Time& time);
ParameterList output(Case::Output& output);
/// `precision` holds the word for Case::Run::precision.
ParameterList run(Case::Run& run, std::string& precision);
ParameterList solid(Case::Solid& solid);
/// The name of the plugin that a section chooses, under the key `chooser`.
ParameterList plugin(std::string& type, const std::string& chooser = "type");
/// `every` holds the number for ObserverTiming::every; 0: not given.
ParameterList timing(ObserverTiming& timing, std::int64_t& every);

}  // namespace mesogen::case_keys
