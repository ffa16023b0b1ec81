#pragma once

#include <filesystem>

#include "options.hpp"
#include "simulation/run.hpp"

namespace mesogen::app {

/// Of a run in this folder, new or resumed; a signal stops it.
RunOptions run_options(const RunningOptions& options, const std::filesystem::path& folder);

}  // namespace mesogen::app
