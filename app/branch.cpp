#include <memory>

#include "diagnostics/resources.hpp"
#include "room.hpp"
#include "verbs.hpp"

namespace mesogen::app {

namespace {

struct Options {
  std::string folder;
  std::string output;
  std::optional<double> at;
  std::vector<std::string> changes;
  bool overwrite = false;
  PluginFolders plugin_folders;
  RunningOptions running;
};

ExitCode branch(const Options& options) {
  use_threads(options.running);
  const auto registry = load_plugins(options.plugin_folders, options.running.quiet);
  const auto program = static_cast<double>(resident_memory());
  const CaseOptions branched{(std::filesystem::path(options.folder) / "case.toml").string(), options.changes,
                             options.plugin_folders};
  RunOptions run = run_options(options.running, options.output);
  run.overwrite = options.overwrite;
  run.inspect = [&](const Setup& setup) { refuse_beyond_memory(setup, program, with_settings(branched, registry)); };
  Log log = log_of(options.running, *run.ranks);
  Progress progress = progress_of(options.running, *run.ranks);
  return branch_run(registry, {options.folder, options.at}, options.changes, run, log, progress);
}

}  // namespace

void add_branch(Verb& command) {
  const auto options = std::make_shared<Options>();
  Verb& verb = command.verb("branch", "Start a new run from a checkpoint of another, with other parameters",
                            [options] { return branch(*options); });
  verb.argument("DIR", &options->folder, "Folder of the run to branch from, which is only read");
  verb.argument("NEW", &options->output, "Folder for the new run");
  verb.option("--at", "TIME", &options->at,
              "Simulated time of the checkpoint, in the case's unit of time (default: the newest); "
              "output.checkpoint_times and output.checkpoint_every keep checkpoints for this");
  verb.option("--set", "KEY=VALUE", &options->changes,
              "Change a key of the case from that time on; may be repeated. Not allowed: domain.size, particles, the "
              "initial conditions (director, velocity, colour) and other advanced fields");
  verb.flag("--overwrite", &options->overwrite, "First remove the run that is in NEW");
  add_plugin_path(verb, options->plugin_folders);
  add_running(verb, options->running);
}

}  // namespace mesogen::app
