#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "diagnostics/log.hpp"
#include "diagnostics/progress.hpp"
#include "mesogen/export.hpp"
#include "plugin/registry.hpp"
#include "run/setup.hpp"

namespace mesogen {

struct RunOptions {
  std::filesystem::path folder;
  bool overwrite = false;
  bool profile = false;                  ///< print where the time went
  std::filesystem::path trace;           ///< file for a trace of it; empty: none
  const Ranks* ranks = &Ranks::alone();  ///< that share the run
  /// Set by a signal handler: stop at the next step, with a checkpoint.
  const std::atomic<bool>* stop = nullptr;
  /// Looks at the case once it is set up, before anything is written; may throw to refuse it.
  std::function<void(const Setup&)> inspect = {};
};

/// Runs a case into a new folder. Returns `done`, or `interrupted` with a checkpoint written.
MESOGEN_EXPORT ExitCode run_case(Case source, const PluginRegistry& registry, const RunOptions& options, Log& log,
                                 Progress& progress);
/// Continues the run in a folder from its newest valid checkpoint to the same bits as an unbroken run. `changes`:
/// overrides of the few keys that may change while a run goes on, time.end above all. A finished run that nothing
/// changes is left as it is.
MESOGEN_EXPORT ExitCode resume_run(const PluginRegistry& registry, const RunOptions& options,
                                   const std::vector<std::string>& changes, Log& log, Progress& progress);

/// Where a branch starts from.
struct BranchPoint {
  std::filesystem::path folder;  ///< of a run, which is only read
  std::optional<double> at;      ///< time of a checkpoint, s; none: the newest
};
/// Starts a new run in options.folder from a checkpoint of another, with other parameters.
MESOGEN_EXPORT ExitCode branch_run(const PluginRegistry& registry, const BranchPoint& from,
                                   const std::vector<std::string>& changes, const RunOptions& options, Log& log,
                                   Progress& progress);

}  // namespace mesogen
