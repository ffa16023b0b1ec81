#include <memory>
#include <string>
#include <vector>

#include "python.hpp"
#include "verbs.hpp"

namespace mesogen::app {

void add_report(CLI::App& command, Action& action) {
  struct Options {
    std::string folder;
    std::string output;
    int frame = -1;
    std::string frames;
    std::string every;
  };
  const auto options = std::make_shared<Options>();
  auto* const verb = command.add_subcommand("report", "Draw pictures of a run's results");
  verb->add_option("folder", options->folder, "Folder of a run")->type_name("DIR")->required();
  verb->add_option("-o,--output", options->output, "Folder for the pictures (default: DIR/report)")->type_name("DIR");
  auto* const frame = verb->add_option("--frame", options->frame,
                                       "Frame to draw; negative numbers count from the end (default: the last)")
                          ->type_name("N");
  verb->add_option("--frames", options->frames,
                   "Draw frames A to B, both included, each to files of its own, director_000012.png; A or B may be "
                   "left out; negative numbers count from the end")
      ->type_name("A:B")
      ->excludes(frame);
  verb->add_option("--every", options->every, "Draw each N-th frame, of all or of --frames")
      ->type_name("N")
      ->check(CLI::PositiveNumber)
      ->excludes(frame);
  verb->callback([&action, options] {
    action = [options]() -> ExitCode {
      std::vector<std::string> arguments;
      if (!options->frames.empty()) arguments.push_back("--frames=" + options->frames);
      if (!options->every.empty()) arguments.push_back("--every=" + options->every);
      if (arguments.empty()) arguments.push_back("--frame=" + std::to_string(options->frame));
      if (!options->output.empty()) arguments.push_back("--output=" + options->output);
      arguments.insert(arguments.end(), {"--", options->folder});
      hand_over("report", "mesogen.report", arguments);
    };
  });
}

}  // namespace mesogen::app
