#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "python.hpp"
#include "verbs.hpp"

namespace mesogen::app {

void add_chart(CLI::App& command, Action& action) {
  struct Options {
    std::string study;
    std::string output;
    std::vector<std::string> only;
    bool list = false;
    bool draw_only = false;
    bool quiet = false;
  };
  const auto options = std::make_shared<Options>();
  auto* const verb = command.add_subcommand(
      "chart", "Run a study, resuming where it was left, and chart error against cost, or where methods fail");
  verb->add_option("study", options->study, "Study file (TOML)")->type_name("STUDY")->required();
  verb->add_option("-o,--output", options->output,
                   "Folder for the runs' figures, tables and charts (default: output/charts/<name of the study>)")
      ->type_name("DIR");
  verb->add_option("--only", options->only, "Take these variants alone; may be repeated")
      ->type_name("VARIANT")
      ->delimiter(',');
  verb->add_flag("--list", options->list, "List the runs and whether they are done, as commands; runs nothing");
  verb->add_flag("--draw-only", options->draw_only, "Run nothing: tables and charts of what is there");
  verb->add_flag("--quiet", options->quiet, "Only the tables, warnings and errors, no progress");
  verb->callback([&action, options] {
    action = [options]() -> ExitCode {
      std::vector<std::string> arguments{"--mesogen=" + std::filesystem::read_symlink("/proc/self/exe").string()};
      if (!options->output.empty()) arguments.push_back("--output=" + options->output);
      for (const auto& variant : options->only) arguments.push_back("--only=" + variant);
      if (options->list) arguments.emplace_back("--list");
      if (options->draw_only) arguments.emplace_back("--draw-only");
      if (options->quiet) arguments.emplace_back("--quiet");
      arguments.insert(arguments.end(), {"--", options->study});
      hand_over("chart", "mesogen.charts", arguments);
    };
  });
}

}  // namespace mesogen::app
