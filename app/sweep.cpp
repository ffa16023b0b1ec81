#include <memory>

#include "python.hpp"
#include "verbs.hpp"

namespace mesogen::app {

void add_sweep(Verb& command) {
  const auto given = std::make_shared<Forwarded>(with_this_mesogen());
  Verb& verb = command.verb("sweep", "Run or continue a case over parameters and seeds; writes means with errors",
                            [given] { return hand_over("sweep", "mesogen.sweep", *given); });
  verb.argument("SWEEP", given.get(), "Sweep file (TOML)");
  verb.option("--output", "DIR", given.get(),
              "Folder for the runs and the tables (default: output/sweeps/<name of the sweep>)", {.letter = 'o'});
  verb.option("--parallel", "N", given.get(), "Runs at the same time, 1 to 4096 (default: what the sweep file says)",
              {.lowest = 1, .highest = 4096});
  verb.option("--threads", "N", given.get(), "Threads of each run, 1 to 4096 (default: what the sweep file says)",
              {.lowest = 1, .highest = 4096});
  verb.flag("--retry", given.get(), "Try failed runs again");
  verb.flag("--list", given.get(), "List the runs as commands, with the state of each; runs nothing",
            {.excludes = {"--collect-only", "--slurm", "--task"}});
  verb.flag("--collect-only", given.get(), "Run nothing; write tables of the runs that are done",
            {.excludes = {"--slurm", "--task"}});
  verb.flag("--slurm", given.get(), "Submit what is missing to Slurm as a job array, one task per run",
            {.excludes = {"--task"}});
  verb.option("--slurm-options", "TEXT", given.get(),
              "Options for sbatch in one text, for example \"--time=12:00:00 --partition=long\"", {.needs = "--slurm"});
  verb.flag("--dry-run", given.get(), "Write the job array, but do not submit it", {.needs = "--slurm"});
  verb.option("--task", "N", given.get(), "Do the run of one task of the job array, counted from 1", {.lowest = 1});
  verb.flag("--quiet", given.get(), "Print the tables, warnings and errors only, no progress");
}

}  // namespace mesogen::app
