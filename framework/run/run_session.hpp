#pragma once

#include "output/checkpoint.hpp"
#include "run/run.hpp"

/// One session of a run: a process that computes some of its steps, in a folder that the caller has locked.
namespace mesogen {

/// From the initial conditions, into a folder that holds nothing but the case.
ExitCode start_session(Setup& setup, const RunOptions& options, Log& log, Progress& progress);
/// From the initial conditions, after a kill before the first checkpoint: whatever results there are make room.
ExitCode start_session_again(Setup& setup, const RunOptions& options, Log& log, Progress& progress);
/// From a checkpoint.
ExitCode continue_session(Setup& setup, const Checkpoint& checkpoint, const RunOptions& options, Log& log,
                          Progress& progress);

}  // namespace mesogen
