#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "diagnostics/resources.hpp"
#include "room.hpp"
#include "run/resume_rules.hpp"
#include "verbs.hpp"

namespace mesogen::app {

namespace {

struct Options {
  std::string folder;
  std::vector<std::string> changes;
  PluginFolders plugin_folders;
  RunningOptions running;
};

ExitCode resume(const Options& options) {
  use_threads(options.running);
  const auto registry = load_plugins(options.plugin_folders, options.running.quiet);
  const auto program = static_cast<double>(resident_memory());
  const CaseOptions stored{(std::filesystem::path(options.folder) / "case.toml").string(), {}, options.plugin_folders};
  RunOptions run = run_options(options.running, options.folder);
  // It began elsewhere, perhaps, where there was more memory.
  run.inspect = [&](const Setup& setup) { refuse_beyond_memory(setup, program, with_settings(stored, registry)); };
  Log log = log_of(options.running, *run.ranks);
  Progress progress = progress_of(options.running, *run.ranks);
  return resume_run(registry, run, options.changes, log, progress);
}

}  // namespace

void add_resume(Verb& command) {
  const auto options = std::make_shared<Options>();
  Verb& verb = command.verb("resume", "Continue a run from its newest checkpoint, or extend it",
                            [options] { return resume(*options); });
  verb.argument("DIR", &options->folder, "Folder of the run");
  verb.option("--set", "KEY=VALUE", &options->changes,
              fmt::format("Change a key of the case; may be repeated. time.end=20 extends the run. Allowed are only "
                          "keys that do not change the past: {}; `mesogen branch` changes others",
                          fmt::join(resumable_keys(), ", ")));
  add_plugin_path(verb, options->plugin_folders);
  add_running(verb, options->running);
}

}  // namespace mesogen::app
