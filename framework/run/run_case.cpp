#include "output/run_folder.hpp"
#include "run/run_session.hpp"
#include "run/run_trace.hpp"

namespace mesogen {

ExitCode run_case(Case source, const PluginRegistry& registry, const RunOptions& options, Log& log,
                  Progress& progress) {
  Problems problems;
  const auto setup = set_up(std::move(source), registry, problems);
  if (options.inspect) options.inspect(*setup);
  setup->ranks = options.ranks;
  RunTrace::check(options.trace, options.folder);
  if (!options.ranks->is_first()) return start_session(*setup, options, log, progress);
  const RunLock lock = start_run_folder(options.folder, setup->resolved_text, options.overwrite);
  return start_session(*setup, options, log, progress);
}

}  // namespace mesogen
