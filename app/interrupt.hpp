#pragma once

#include <atomic>

namespace mesogen::app {

/// From now on SIGINT (Ctrl-C), SIGTERM and SIGUSR1 (which mpirun passes on to all ranks) set the flag that this
/// returns, so that the run can end at a step boundary with a checkpoint; a second such signal ends the process at
/// once.
const std::atomic<bool>& stop_on_signal();

}  // namespace mesogen::app
