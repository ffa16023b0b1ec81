#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "plugin/registry.hpp"
#include "simulation/setup.hpp"

namespace mesogen::app {

/// Where plugins are looked for, beside the usual places.
using PluginFolders = std::vector<std::filesystem::path>;

void add_plugin_path(CLI::App& verb, PluginFolders& folders);

/// Loads the plugins; tells on stderr which files were refused, unless `quiet`.
PluginRegistry load_plugins(const PluginFolders& folders, bool quiet = false, Twins twins = Twins::refused);

/// A case file, what is changed in it, and its plugins.
struct CaseOptions {
  std::string file;
  std::vector<std::string> overrides;
  PluginFolders plugin_folders;
};

void add_case(CLI::App& verb, CaseOptions& options);

/// The case, if nothing is wrong with it so far. Otherwise throws an Error with all that is wrong, including what only
/// its plugins know.
Case read(const CaseOptions& options, const PluginRegistry& registry);

/// The case with its plugins made and its step ordered.
std::unique_ptr<Setup> set_up(const CaseOptions& options, const PluginRegistry& registry);

/// How a run goes, new or resumed.
struct RunningOptions {
  int threads = 0;  ///< 0: as OpenMP decides
  bool quiet = false;
  bool profile = false;
  std::string trace;  ///< empty: none
};

void add_running(CLI::App& verb, RunningOptions& options);
/// --threads and --quiet alone.
void add_threads(CLI::App& verb, RunningOptions& options);
void use_threads(const RunningOptions& options);

}  // namespace mesogen::app
