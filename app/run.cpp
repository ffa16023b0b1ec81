#include "run/run.hpp"

#include <memory>

#include "diagnostics/resources.hpp"
#include "room.hpp"
#include "verbs.hpp"

namespace mesogen::app {

namespace {

struct Options {
  CaseOptions source;
  RunningOptions running;
  std::string output;
  bool overwrite = false;
};

/// output/<name>: the file's own name, or that of its folder if it is called case.toml.
std::filesystem::path default_folder(const std::string& case_file) {
  const auto file = std::filesystem::absolute(case_file).lexically_normal();
  const auto name = file.stem() == "case" ? file.parent_path().filename() : file.stem();
  return std::filesystem::path("output") / name;
}

/// Refuses the folder in which the run's own case.toml would replace the case given.
void keep_case(const std::filesystem::path& folder, const std::string& case_file) {
  const auto stored = folder / "case.toml";
  std::error_code ignored;
  if (std::filesystem::equivalent(stored, case_file, ignored))
    throw Error(ExitCode::bad_case, stored.string() +
                                        " is the case to be run, and a run keeps its own case.toml there: choose "
                                        "another --output");
}

ExitCode run(const Options& options) {
  use_threads(options.running);
  const auto registry = load_plugins(options.source.plugin_folders, options.running.quiet);
  const auto program = static_cast<double>(resident_memory());
  const SetUpWith set_up_with = with_settings(options.source, registry);
  Case source = read(options.source, registry);
  refuse_far_beyond_memory(source, program, set_up_with);
  const std::filesystem::path folder = options.output;
  RunOptions run = run_options(options.running, folder.empty() ? default_folder(options.source.file) : folder);
  keep_case(run.folder, options.source.file);
  run.overwrite = options.overwrite;
  Log log = log_of(options.running, *run.ranks);
  run.inspect = [&](const Setup& setup) {
    refuse_beyond_memory(setup, program, set_up_with);
    warn_of_limits(setup, run.folder, log);
  };
  Progress progress = progress_of(options.running, *run.ranks);
  return run_case(std::move(source), registry, run, log, progress);
}

}  // namespace

void add_run(Verb& command) {
  const auto options = std::make_shared<Options>();
  Verb& verb = command.verb("run", "Run a case", [options] { return run(*options); });
  add_case(verb, options->source);
  verb.option("--output", "DIR", &options->output, "Folder for the results (default: output/<name of the case>)",
              {.letter = 'o'});
  verb.flag("--overwrite", &options->overwrite, "First remove the run that is in the folder");
  add_running(verb, options->running);
}

}  // namespace mesogen::app
