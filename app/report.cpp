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
  };
  const auto options = std::make_shared<Options>();
  auto* const verb = command.add_subcommand("report", "Draw pictures of a run's results");
  verb->add_option("folder", options->folder, "Folder of a run")->type_name("DIR")->required();
  verb->add_option("-o,--output", options->output, "Folder for the pictures (default: DIR/report)")->type_name("DIR");
  verb->add_option("--frame", options->frame, "Frame to draw; negative numbers count from the end (default: the last)")
      ->type_name("N");
  verb->callback([&action, options] {
    action = [options]() -> ExitCode {
      std::vector<std::string> arguments{"--frame=" + std::to_string(options->frame)};
      if (!options->output.empty()) arguments.push_back("--output=" + options->output);
      arguments.insert(arguments.end(), {"--", options->folder});
      hand_over("report", "mesogen.report", arguments);
    };
  });
}

}  // namespace mesogen::app
