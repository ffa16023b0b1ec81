#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "python.hpp"
#include "verbs.hpp"

namespace mesogen::app {

void add_study(CLI::App& command, Action& action) {
  struct Options {
    std::string study;
    std::string output;
    std::string parallel;
    std::vector<std::string> only;
    bool quick = false;
    bool full = false;
    bool write_only = false;
    bool retry = false;
    bool quiet = false;
  };
  const auto options = std::make_shared<Options>();
  auto* const verb = command.add_subcommand(
      "study", "Run all that a study needs, resuming where it was left, and report which claims hold");
  verb->add_option("study", options->study, "Folder of a study, such as studies/paper")
      ->type_name("FOLDER")
      ->required();
  verb->add_option("-o,--output", options->output,
                   "Folder for runs and report (default: output/studies/<name of the folder>)")
      ->type_name("DIR");
  verb->add_option("--only", options->only, "Take these sections alone; may be repeated")
      ->type_name("SECTION")
      ->delimiter(',');
  verb->add_option("--parallel", options->parallel, "Runs at a time (default: as many as there are cores)")
      ->type_name("N");
  auto* const quick = verb->add_flag("--quick", options->quick, "Small boxes and short spans: what to expect");
  verb->add_flag("--full", options->full, "At the resolution of the paper")->excludes(quick);
  verb->add_flag("--retry", options->retry, "Try runs that failed again");
  verb->add_flag("--write-only", options->write_only, "Run nothing: the report of what is there");
  verb->add_flag("--quiet", options->quiet, "Only the verdicts, warnings and errors, no progress");
  verb->callback([&action, options] {
    action = [options]() -> ExitCode {
      std::vector<std::string> arguments{"--mesogen=" + std::filesystem::read_symlink("/proc/self/exe").string()};
      if (!options->output.empty()) arguments.push_back("--output=" + options->output);
      if (!options->parallel.empty()) arguments.push_back("--parallel=" + options->parallel);
      for (const auto& section : options->only) arguments.push_back("--only=" + section);
      if (options->quick) arguments.emplace_back("--quick");
      if (options->full) arguments.emplace_back("--full");
      if (options->write_only) arguments.emplace_back("--write-only");
      if (options->retry) arguments.emplace_back("--retry");
      if (options->quiet) arguments.emplace_back("--quiet");
      arguments.insert(arguments.end(), {"--", options->study});
      hand_over("study", "mesogen.study", arguments);
    };
  });
}

}  // namespace mesogen::app
