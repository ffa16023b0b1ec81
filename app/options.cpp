#include "options.hpp"

#include <fmt/format.h>
#include <omp.h>

#include "plugin/crash.hpp"

namespace mesogen::app {

void add_plugin_path(CLI::App& verb, PluginFolders& folders) {
  verb.add_option("--plugin-path", folders, "Folder searched for plugins before all others; may be repeated")
      ->type_name("DIR")
      ->allow_extra_args(false);
}

PluginRegistry load_plugins(const PluginFolders& folders, bool quiet, Twins twins) {
  auto registry = PluginRegistry::scan(folders, twins);
  if (!quiet)
    for (const auto& line : registry.refusals()) fmt::print(stderr, "warning: plugin refused: {}\n", line);
  return registry;
}

void add_case(CLI::App& verb, CaseOptions& options) {
  verb.add_option("case", options.file, "Case file (TOML)")->type_name("CASE")->required();
  verb.add_option("--set", options.overrides,
                  "Change a key of the case, such as physics.activity.activity=0.05; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  add_plugin_path(verb, options.plugin_folders);
}

Case read(const CaseOptions& options, const PluginRegistry& registry) {
  Problems problems;
  Case source = read_case(options.file, options.overrides, problems);
  // Reports the plugins' complaints too: all errors at once.
  if (!problems.empty()) mesogen::set_up(std::move(source), registry, problems);
  return source;
}

std::unique_ptr<Setup> set_up(const CaseOptions& options, const PluginRegistry& registry) {
  Problems problems;
  Case source = read_case(options.file, options.overrides, problems);
  return mesogen::set_up(std::move(source), registry, problems);
}

void add_threads(CLI::App& verb, RunningOptions& options) {
  verb.add_option("--threads", options.threads, "Threads to compute with (default: all cores, or OMP_NUM_THREADS)")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
  verb.add_flag("--quiet", options.quiet, "Only warnings and errors, no progress");
}

void add_running(CLI::App& verb, RunningOptions& options) {
  add_threads(verb, options);
  verb.add_flag("--profile", options.profile, "Tell at the end where the time went");
  verb.add_option(
          "--trace", options.trace,
          "Write when each pass, sample, frame and checkpoint ran: JSON that Perfetto and chrome://tracing open")
      ->type_name("FILE");
}

void use_threads(const RunningOptions& options) {
  if (options.threads > 0) omp_set_num_threads(options.threads);
  tell_of_crashes_in_threads();
}

}  // namespace mesogen::app
