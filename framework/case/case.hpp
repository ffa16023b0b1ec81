#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "case/problems.hpp"
#include "case/section.hpp"
#include "case/units.hpp"
#include "mesogen/export.hpp"
#include "mesogen/fields/rank.hpp"
#include "mesogen/plugin/parameters.hpp"

namespace mesogen {

/// A plugin that the case asks for. Whether there is such a plugin is for the registry to say.
struct PluginChoice {
  std::string type;      ///< name of the plugin; empty if a problem was reported
  std::string instance;  ///< "flow" of [physics.flow]; "kernel"; "boundary"; "director"
  CaseSection section;
  std::string type_key;                     ///< full key of the name, "physics.flow.type", for messages
  SourcePlace type_place;                   ///< where the name stands
  std::vector<std::string> framework_keys;  ///< keys of the section that the framework reads

  /// Reads the plugin's own parameters. Throws an Error if the plugin declares a key of the framework's.
  MESOGEN_EXPORT void read(const ParameterList& list, Problems& problems) const;
};

/// When an observer samples beside the start and the end of a run: at most one of the two is given.
struct ObserverTiming {
  std::optional<double> interval;     ///< s of simulated time
  std::optional<std::int64_t> every;  ///< steps
};

/// A case, checked, without the plugins' own parameters.
struct MESOGEN_EXPORT Case {
  struct Domain {
    std::vector<double> size;  ///< edge lengths, m: one for each dimension of the scene
  };
  /// What the framework reads of [solids.NAME].
  struct Solid {
    std::string fluid = "outside";             ///< on which side of its surface: inside or outside
    std::vector<double> velocity{0.0, 0.0};    ///< of the surface, m/s
    double angular_velocity = 0.0;             ///< about the centre of the shape, rad/s
    WordOrNumber slip{"none"};                 ///< none, free, or a length, m
    std::string anchoring = "none";            ///< none, tangential, normal or angle
    double angle = 0.0;                        ///< of the director from the tangent, degrees
    std::optional<double> anchoring_strength;  ///< W, N/m; none: strong
    double order = 1.0;                        ///< order q that the surface prefers
  };
  struct Particles {
    double spacing = 0.0;                 ///< m
    std::string arrangement = "lattice";  ///< lattice, hexagonal or jittered
    std::int64_t seed = 1;
    double jitter = 0.2;  ///< largest shift along each axis, in spacings; jittered only
  };
  struct Time {
    double end = 0.0;                 ///< s
    std::optional<double> step;       ///< s; none: chosen automatically
    double factor = 1.0;              ///< automatic step in multiples of its stability limit
    std::string scheme = "midpoint";  ///< see TimeScheme
    std::string stepping = "auto";    ///< explicit, stabilised or auto
  };
  struct Output {
    double interval = 0.0;                   ///< s of simulated time; by default the end of the run
    double checkpoint_interval = 60.0;       ///< s of wall time
    std::vector<double> checkpoint_times;    ///< s of simulated time: checkpoints kept for good
    std::optional<double> checkpoint_every;  ///< s of simulated time between such
    /// Without position, which is always stored. If not given in the case: those that plugins declare as shown.
    std::vector<std::string> fields;
    bool fields_given = false;
  };
  struct Run {
    Precision precision = Precision::single_precision;
    std::string device = "cpu";
  };

  std::string title;
  std::string file;  ///< as given, for messages
  Units units;       ///< of all numbers below, in place of m, s and N where the case says so
  Domain domain;
  Particles particles;
  PluginChoice boundary;
  std::vector<PluginChoice> shapes;  ///< of the solids, in the order of the file
  std::vector<Solid> solids;
  PluginChoice kernel;
  double smoothing_length_ratio = 4.0 / 3.0;  ///< h in particle spacings; key kernel.smoothing_length
  std::string laplacian = "consistent";       ///< or "plain"; key kernel.laplacian
  std::vector<PluginChoice> initial;          ///< sections that are not the framework's own, in the order of the file
  Time time;
  std::vector<PluginChoice> physics;    ///< in the order of the file
  std::vector<PluginChoice> observers;  ///< in the order of the file
  std::vector<ObserverTiming> timings;  ///< of each observer
  Output output;
  Run run;
  /// The case as TOML with overrides applied and every default of the framework filled in. Reads back to the same
  /// case. Plugins' defaults are added by ResolvedCase (case/resolved.hpp).
  std::string resolved_text;
  std::shared_ptr<const Value> tree;  ///< everything as it stands in the file

  /// Dimensions of the scene: how many numbers domain.size has. Where these were refused, the fewest that Mesogen is
  /// built for, so that plugins can still be made and asked for what else is wrong.
  [[nodiscard]] int dimension() const;
  /// Where a key stands, or the innermost table on the way to it.
  [[nodiscard]] SourcePlace place(std::string_view dotted_key) const;
};

/// Reads a case file. Never throws for what is wrong with the case: all of that is added to `problems`, and the case
/// is then not to be used beyond its plugin choices, whose parameters can still be checked.
/// `overrides` are texts such as "physics.activity.activity=0.05"; the value is TOML, or else taken as a text.
MESOGEN_EXPORT Case read_case(const std::string& path, const std::vector<std::string>& overrides, Problems& problems);
/// The same from a text; `name` stands for the file in messages.
MESOGEN_EXPORT Case read_case_text(std::string_view text, const std::string& name,
                                   const std::vector<std::string>& overrides, Problems& problems);
/// The case in `text` with the observers of the file `observers` (none if empty), of which nothing else is used.
/// Overrides may change keys of observers alone.
MESOGEN_EXPORT Case read_case_with_observers(std::string_view text, const std::string& name,
                                             const std::string& observers, const std::vector<std::string>& overrides,
                                             Problems& problems);

}  // namespace mesogen
