#include "simulation/replay.hpp"

#include <memory>

#include "options.hpp"
#include "verbs.hpp"

namespace mesogen::app {

namespace {

struct Options {
  std::string folder;
  std::string output;
  CaseOptions observers;
  RunningOptions running;
  bool overwrite = false;
};

ExitCode replay(const Options& options) {
  use_threads(options.running);
  const auto registry = load_plugins(options.observers.plugin_folders, options.running.quiet);
  ReplayOptions replay;
  replay.folder = options.folder;
  replay.observers = options.observers.file;
  replay.overrides = options.observers.overrides;
  replay.output = options.output;
  replay.overwrite = options.overwrite;
  Log log(options.running.quiet);
  return replay_run(registry, replay, log);
}

}  // namespace

void add_replay(CLI::App& command, Action& action) {
  const auto options = std::make_shared<Options>();
  auto* const verb = command.add_subcommand("replay", "Run observers, also new ones, over the stored frames of a run");
  verb->add_option("folder", options->folder, "Folder of the run")->type_name("DIR")->required();
  verb->add_option("case", options->observers.file,
                   "Case file whose [observers.*] are used, and nothing else of it (default: those of the run)")
      ->type_name("CASE");
  verb->add_option("-o,--output", options->output, "File for the samples (default: DIR/replay.h5)")->type_name("FILE");
  verb->add_flag("--overwrite", options->overwrite, "Replace the file for the samples if it is there");
  verb->add_option("--set", options->observers.overrides,
                   "Change a key of an observer, such as observers.paths.count=8; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  add_plugin_path(*verb, options->observers.plugin_folders);
  add_threads(*verb, options->running);
  verb->callback([&action, options] { action = [options] { return replay(*options); }; });
}

}  // namespace mesogen::app
