#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/descriptor.hpp"
#include "mesogen/plugin/initial.hpp"
#include "mesogen/plugin/kernel.hpp"
#include "mesogen/plugin/observer.hpp"
#include "mesogen/plugin/physics.hpp"
#include "mesogen/plugin/shape.hpp"
#include "plugin/plugin_pointer.hpp"

namespace mesogen {

/// "kernel", "boundary", "shape", "initial", "physics", "observer".
MESOGEN_EXPORT std::string_view to_string(PluginKind kind);

/// All kinds, in the order in which a case is best read.
inline constexpr std::array plugin_kinds{PluginKind::kernel,  PluginKind::boundary, PluginKind::shape,
                                         PluginKind::initial, PluginKind::physics,  PluginKind::observer};

/// A plugin whose library is loaded and whose descriptor was checked. Libraries stay loaded until the process ends, so
/// the descriptor is valid as long.
struct LoadedPlugin {
  const PluginDescriptor* descriptor = nullptr;
  std::filesystem::path file;   ///< absolute; the one that was loaded
  std::string instruction_set;  ///< "baseline", "x86-64-v3", "x86-64-v4"
};

/// The dimensions in which a plugin can be used: those for which both it has a form and Mesogen is built.
MESOGEN_EXPORT DimensionSet usable_dimensions(const PluginDescriptor& plugin);

/// A file of a plugin folder that could not be used, and why.
struct RefusedPlugin {
  std::filesystem::path file;
  std::string reason;
};

/// What two files are that offer plugins of the same kind and name.
enum class Twins {
  refused,      ///< an error: which one a run takes should not hang on the order of folders
  first_folder  ///< the one of the folder searched first is taken, as a test of it must; in one folder still an error
};

/// All plugins that can be used.
class MESOGEN_EXPORT PluginRegistry {
 public:
  /// Searches `folders` (--plugin-path), then those of the variable MESOGEN_PLUGIN_PATH (separated by colons), then the
  /// folder of this installation. Throws Error if one of `folders` is no folder, and for twins that are refused.
  static PluginRegistry scan(const std::vector<std::filesystem::path>& folders = {}, Twins twins = Twins::refused);
  /// Searches these folders and no others.
  static PluginRegistry only(const std::vector<std::filesystem::path>& folders);

  /// Sorted by kind and name.
  [[nodiscard]] const std::vector<LoadedPlugin>& all() const { return plugins_; }
  /// nullptr if there is none.
  [[nodiscard]] const LoadedPlugin* find(PluginKind kind, std::string_view name) const;
  /// Sorted.
  [[nodiscard]] std::vector<std::string> names(PluginKind kind) const;
  [[nodiscard]] const std::vector<RefusedPlugin>& refused() const { return refused_; }
  /// Each as one line: file and reason.
  [[nodiscard]] std::vector<std::string> refusals() const;

  /// Why there is no such plugin: plugin_refused if a file of that name was refused, bad_case otherwise, with the
  /// nearest name and how a plugin of one's own is found. For a case, put its place before what().
  [[nodiscard]] Error missing(PluginKind kind, std::string_view name) const;
  /// The same for a plugin of any kind.
  [[nodiscard]] Error missing(std::string_view name) const;

  /// A new object each. Throw missing(), and Error if the plugin has no form for this precision and dimension.
  [[nodiscard]] PluginPointer<Kernel> make_kernel(std::string_view name, int dimension) const;
  /// `length_unit`: of the case, for messages about places.
  [[nodiscard]] std::unique_ptr<Boundary> make_boundary(std::string_view name, int dimension,
                                                        std::string length_unit = "m") const;
  [[nodiscard]] PluginPointer<Shape> make_shape(std::string_view name, int dimension) const;
  [[nodiscard]] PluginPointer<Initial> make_initial(std::string_view name, int dimension) const;
  [[nodiscard]] PluginPointer<Observer> make_observer(std::string_view name, int dimension) const;
  [[nodiscard]] PluginPointer<Physics> make_physics(std::string_view name, Precision precision, int dimension) const;
  /// A dimension in which a plugin can be asked what it is, without a case: the smallest of its own for which Mesogen
  /// is built. Throws missing(), and Error if there is none.
  [[nodiscard]] int smallest_dimension(PluginKind kind, std::string_view name) const;
  /// Has a physics plugin a library for CUDA?
  [[nodiscard]] bool has_cuda(std::string_view physics) const;
  /// Loads that library: why it cannot be used; empty if it can.
  [[nodiscard]] std::string cuda_problem(std::string_view physics) const;
  /// The same from the plugin's library for CUDA, which it must have.
  [[nodiscard]] PluginPointer<Physics> make_physics_for_cuda(std::string_view name, Precision precision,
                                                             int dimension) const;

 private:
  [[nodiscard]] std::vector<std::string> paths() const;
  [[nodiscard]] Error missing(std::string_view what, std::string_view name, const std::vector<std::string>& known,
                              std::string_view all) const;
  void add_folder(const std::filesystem::path& folder);
  void add_file(const std::filesystem::path& file);
  void sort();
  struct CudaTwin {
    const PluginDescriptor* descriptor = nullptr;
    std::string problem;
  };
  [[nodiscard]] CudaTwin cuda_twin(std::string_view physics) const;
  [[nodiscard]] const PluginDescriptor& descriptor(PluginKind kind, std::string_view name) const;

  std::vector<std::filesystem::path> folders_;  // canonical, each searched once
  std::vector<LoadedPlugin> plugins_;
  std::size_t of_earlier_folders_ = 0;  // how many of them, while a folder is searched
  Twins twins_ = Twins::refused;
  std::vector<RefusedPlugin> refused_;
};

}  // namespace mesogen
