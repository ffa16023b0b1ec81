#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "diagnostics/log.hpp"
#include "diagnostics/progress.hpp"
#include "mesogen/export.hpp"
#include "plugin/registry.hpp"
#include "simulation/setup.hpp"

namespace mesogen {

struct RunOptions {
  std::filesystem::path folder;
  bool overwrite = false;
  bool profile = false;         ///< print where the time went
  std::filesystem::path trace;  ///< file for a trace of it; empty: none
  /// Set by a signal handler: stop at the next step, with a checkpoint.
  const std::atomic<bool>* stop = nullptr;
  /// Looks at the case once it is set up, before anything is written; may throw to refuse it.
  std::function<void(const Setup&)> inspect = {};
};

/// Runs a case into a new folder. Returns `done`, or `interrupted` with a checkpoint written.
MESOGEN_EXPORT ExitCode run_case(Case source, const PluginRegistry& registry, const RunOptions& options, Log& log,
                                 Progress& progress);
/// Continues the run in a folder from its newest valid checkpoint to the same bits as an unbroken run.
MESOGEN_EXPORT ExitCode resume_run(const PluginRegistry& registry, const RunOptions& options, Log& log,
                                   Progress& progress);

}  // namespace mesogen
