#pragma once

#include <memory>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "command_line/verb.hpp"
#include "plugin/registry.hpp"
#include "run/run.hpp"

namespace mesogen::app {

/// Where plugins are looked for, beside the usual places.
using PluginFolders = std::vector<std::string>;

void add_plugin_path(Verb& verb, PluginFolders& folders);

/// Loads the plugins; tells on stderr which files were refused, unless `quiet`.
PluginRegistry load_plugins(const PluginFolders& folders, bool quiet = false, Twins twins = Twins::refused);

/// A case file, what is changed in it, and its plugins.
struct CaseOptions {
  std::string file;
  std::vector<std::string> overrides;
  PluginFolders plugin_folders;
};

void add_case(Verb& verb, CaseOptions& options);

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

void add_running(Verb& verb, RunningOptions& options);
void add_threads(Verb& verb, int& threads);
void add_quiet(Verb& verb, bool& quiet);
/// Of a run in this folder, new or resumed; a signal stops it.
RunOptions run_options(const RunningOptions& options, const std::filesystem::path& folder);
/// What such a run tells on stderr: the first rank alone speaks.
Log log_of(const RunningOptions& options, const Ranks& ranks);
Progress progress_of(const RunningOptions& options, const Ranks& ranks);
void use_threads(const RunningOptions& options);

}  // namespace mesogen::app
