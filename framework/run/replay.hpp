#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "diagnostics/log.hpp"
#include "mesogen/diagnostics/error.hpp"
#include "mesogen/export.hpp"
#include "plugin/registry.hpp"

namespace mesogen {

struct ReplayOptions {
  std::filesystem::path folder;        ///< of the run
  std::string observers;               ///< case file whose observers are used; empty: those of the run
  std::vector<std::string> overrides;  ///< of keys of observers
  std::filesystem::path output;        ///< empty: replay.h5 in the folder
  bool overwrite = false;              ///< the output may be there already
};

/// Runs observers over the stored frames of a run and writes their samples, one a frame, to a file of their own. Fields
/// are those of the frames, what the initial conditions set for good, and what the framework derives from these.
MESOGEN_EXPORT ExitCode replay_run(const PluginRegistry& registry, const ReplayOptions& options, Log& log);

}  // namespace mesogen
