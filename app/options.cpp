#include "options.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <iostream>

#include "interrupt.hpp"
#include "plugin/crash.hpp"
#include "ranks/mpi_library.hpp"

namespace mesogen::app {

void add_plugin_path(Verb& verb, PluginFolders& folders) {
  verb.option("--plugin-path", "DIR", &folders,
              "Folder searched for plugins before those of MESOGEN_PLUGIN_PATH and those installed; may be repeated");
}

PluginRegistry load_plugins(const PluginFolders& folders, bool quiet, Twins twins) {
  auto registry = PluginRegistry::scan({folders.begin(), folders.end()}, twins);
  if (!quiet)
    for (const auto& line : registry.refusals()) fmt::print(stderr, "warning: plugin refused: {}\n", line);
  return registry;
}

void add_case(Verb& verb, CaseOptions& options) {
  verb.argument("CASE", &options.file, "Case file (TOML), for example cases/quickstart/case.toml");
  verb.option("--set", "KEY=VALUE", &options.overrides,
              "Change a key of the case, for example physics.activity.activity=0.05; may be repeated");
  add_plugin_path(verb, options.plugin_folders);
}

Case read(const CaseOptions& options, const PluginRegistry& registry) {
  Problems problems;
  Case source = read_case(options.file, options.overrides, problems);
  // Reports the plugins' complaints too: all errors at once.
  if (!problems.empty()) mesogen::set_up(source, registry, problems);
  return source;
}

std::unique_ptr<Setup> set_up(const CaseOptions& options, const PluginRegistry& registry) {
  Problems problems;
  Case source = read_case(options.file, options.overrides, problems);
  return mesogen::set_up(std::move(source), registry, problems);
}

void add_threads(Verb& verb, int& threads) {
  verb.option("--threads", "N", &threads,
              "Number of threads, 1 to 4096 (default: OMP_NUM_THREADS, or as many as there are cores)",
              {.lowest = 1, .highest = 4096});
}

void add_quiet(Verb& verb, bool& quiet) { verb.flag("--quiet", &quiet, "Print warnings and errors only, no progress"); }

void add_running(Verb& verb, RunningOptions& options) {
  add_threads(verb, options.threads);
  add_quiet(verb, options.quiet);
  verb.flag("--profile", &options.profile, "Print at the end how much time each pass took");
  verb.option("--trace", "FILE", &options.trace,
              "File for the time of each pass, sample, frame and checkpoint: JSON for Perfetto or chrome://tracing "
              "(default: none)");
}

RunOptions run_options(const RunningOptions& options, const std::filesystem::path& folder) {
  RunOptions run;
  run.folder = folder;
  run.profile = options.profile;
  run.trace = options.trace;
  run.stop = &stop_on_signal();
  run.ranks = &ranks_of_process();
  return run;
}

Log log_of(const RunningOptions& options, const Ranks& ranks) {
  return ranks.is_first() ? Log(options.quiet) : Log::silent();
}

Progress progress_of(const RunningOptions& options, const Ranks& ranks) {
  return {std::cerr, Progress::style_for(2, options.quiet || !ranks.is_first())};
}

void use_threads(const RunningOptions& options) {
  if (options.threads > 0) omp_set_num_threads(options.threads);
  tell_of_crashes_in_threads();
}

}  // namespace mesogen::app
