#pragma once

#include <filesystem>

#include "case/case.hpp"
#include "diagnostics/log.hpp"
#include "forecast/room.hpp"
#include "options.hpp"

/// Does a run fit this machine? What `check` tells, and what `run` and `resume` look at before they write anything.
namespace mesogen::app {

/// Sets up the case of these options, with more settings.
SetUpWith with_settings(const CaseOptions& options, const PluginRegistry& registry);

/// Bytes free on the disk of a folder that may have yet to be made; 0: unknown.
double free_disk(const std::filesystem::path& folder);

/// Throws Error(bad_case) before the case is set up, if that alone would take more memory than there is. `program`:
/// bytes resident before.
void refuse_far_beyond_memory(const Case& source, double program, const SetUpWith& set_up_with);

/// Throws Error(bad_case) if the memory is not enough for a run.
void refuse_beyond_memory(const Setup& setup, double program, const SetUpWith& set_up_with);

/// Warns of a disk that is too full, where a run may still go on for long, and of steps without end.
void warn_of_limits(const Setup& setup, const std::filesystem::path& folder, Log& log);

}  // namespace mesogen::app
