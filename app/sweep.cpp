#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "python.hpp"
#include "verbs.hpp"

namespace mesogen::app {

void add_sweep(CLI::App& command, Action& action) {
  struct Options {
    std::string sweep;
    std::string output;
    std::string slurm_options;
    int parallel = 0;
    int threads = 0;
    int task = 0;
    bool list = false;
    bool retry = false;
    bool collect_only = false;
    bool slurm = false;
    bool dry_run = false;
    bool quiet = false;
  };
  const auto options = std::make_shared<Options>();
  auto* const verb = command.add_subcommand(
      "sweep", "Run a case over parameters and seeds, resuming where it was left, and collect means with errors");
  verb->add_option("sweep", options->sweep, "Sweep file (TOML)")->type_name("SWEEP")->required();
  verb->add_option("-o,--output", options->output,
                   "Folder for the runs and the tables (default: output/sweeps/<name of the sweep>)")
      ->type_name("DIR");
  auto* const list =
      verb->add_flag("--list", options->list, "List the runs and how they stand, as commands; runs nothing");
  verb->add_option("--parallel", options->parallel, "Runs at a time (default: as the sweep has it)")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
  verb->add_option("--threads", options->threads, "Threads of a run (default: as the sweep has it)")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
  verb->add_flag("--retry", options->retry, "Try runs that failed again");
  auto* const collect =
      verb->add_flag("--collect-only", options->collect_only, "Run nothing: tables of what is there")->excludes(list);
  auto* const slurm =
      verb->add_flag("--slurm", options->slurm, "Submit what is missing to Slurm, as a job array: a task a run")
          ->excludes(list)
          ->excludes(collect);
  verb->add_option("--slurm-options", options->slurm_options,
                   "Options for sbatch in one text, such as \"--time=12:00:00 --partition=long\"")
      ->type_name("TEXT")
      ->needs(slurm);
  verb->add_flag("--dry-run", options->dry_run, "Write the job array, but do not submit it")->needs(slurm);
  verb->add_option("--task", options->task, "Do the run of one task of the job array")
      ->type_name("N")
      ->check(CLI::PositiveNumber)
      ->excludes(list)
      ->excludes(collect)
      ->excludes(slurm);
  verb->add_flag("--quiet", options->quiet, "Only the tables, warnings and errors, no progress");
  verb->callback([&action, options] {
    action = [options]() -> ExitCode {
      std::vector<std::string> arguments{"--mesogen=" + std::filesystem::read_symlink("/proc/self/exe").string()};
      if (!options->output.empty()) arguments.push_back("--output=" + options->output);
      if (!options->slurm_options.empty()) arguments.push_back("--slurm-options=" + options->slurm_options);
      if (options->parallel > 0) arguments.push_back("--parallel=" + std::to_string(options->parallel));
      if (options->threads > 0) arguments.push_back("--threads=" + std::to_string(options->threads));
      if (options->task > 0) arguments.push_back("--task=" + std::to_string(options->task));
      if (options->list) arguments.emplace_back("--list");
      if (options->retry) arguments.emplace_back("--retry");
      if (options->collect_only) arguments.emplace_back("--collect-only");
      if (options->slurm) arguments.emplace_back("--slurm");
      if (options->dry_run) arguments.emplace_back("--dry-run");
      if (options->quiet) arguments.emplace_back("--quiet");
      arguments.insert(arguments.end(), {"--", options->sweep});
      hand_over("sweep", "mesogen.sweep", arguments);
    };
  });
}

}  // namespace mesogen::app
