#include "run_options.hpp"

#include "interrupt.hpp"

namespace mesogen::app {

RunOptions run_options(const RunningOptions& options, const std::filesystem::path& folder) {
  RunOptions run;
  run.folder = folder;
  run.profile = options.profile;
  run.trace = options.trace;
  run.stop = &stop_on_signal();
  return run;
}

}  // namespace mesogen::app
