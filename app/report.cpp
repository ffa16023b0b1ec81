#include <memory>

#include "python.hpp"
#include "verbs.hpp"

namespace mesogen::app {

void add_report(Verb& command) {
  const auto given = std::make_shared<Forwarded>();
  Verb& verb = command.verb("report", "Draw pictures of a run's results",
                            [given] { return hand_over("report", "mesogen.report", *given); });
  verb.argument("DIR", given.get(), "Folder of a run");
  verb.option("--output", "DIR", given.get(), "Folder for the pictures (default: report in the folder of the run)",
              {.letter = 'o'});
  verb.option("--frame", "N", given.get(),
              "Frame to draw, counted from 0; negative numbers count from the end (default: -1, the last)",
              {.lowest = -no_limit, .excludes = {"--frames", "--every"}});
  verb.option("--frames", "A:B", given.get(),
              "Draw frames A to B, both included, each in its own files, for example director_000012.png; A or B may "
              "be left out; negative numbers count from the end");
  verb.option("--every", "N", given.get(), "Draw every N-th frame, of all frames or of --frames (default: 1)",
              {.lowest = 1});
}

}  // namespace mesogen::app
