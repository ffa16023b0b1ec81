#include "run/replay.hpp"

#include <memory>

#include "options.hpp"
#include "ranks/mpi_library.hpp"
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
  if (processes_started() > 1)
    throw Error(ExitCode::bad_case, "a replay runs on one process: start it without mpirun or srun");
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

void add_replay(Verb& command) {
  const auto options = std::make_shared<Options>();
  Verb& verb = command.verb("replay", "Run observers, also new ones, over the stored frames of a run",
                            [options] { return replay(*options); });
  verb.argument("DIR", &options->folder, "Folder of the run");
  verb.argument("CASE", &options->observers.file,
                "Case file of which only [observers.*] is used (default: the case of the run)", {.required = false});
  verb.option("--output", "FILE", &options->output, "File for the samples (default: DIR/replay.h5)", {.letter = 'o'});
  verb.flag("--overwrite", &options->overwrite, "Replace the file for the samples if it exists");
  verb.option("--set", "KEY=VALUE", &options->observers.overrides,
              "Change a key of an observer, for example observers.paths.count=8; may be repeated");
  add_plugin_path(verb, options->observers.plugin_folders);
  add_threads(verb, options->running.threads);
  add_quiet(verb, options->running.quiet);
}

}  // namespace mesogen::app
