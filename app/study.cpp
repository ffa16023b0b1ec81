#include <memory>

#include "python.hpp"
#include "verbs.hpp"

namespace mesogen::app {

void add_study(Verb& command) {
  const auto given = std::make_shared<Forwarded>(with_this_mesogen());
  Verb& verb = command.verb("study", "Run or continue all that a study needs, and report which claims hold",
                            [given] { return hand_over("study", "mesogen.study", *given); });
  verb.argument("FOLDER", given.get(), "Folder of a study, for example studies/paper");
  verb.option("--output", "DIR", given.get(),
              "Folder for runs and report (default: output/studies/<name of the folder>)", {.letter = 'o'});
  verb.option("--only", "SECTION", given.get(),
              "Run only this section, or several separated by commas; may be repeated (default: all)",
              {.repeated = true});
  verb.option("--parallel", "N", given.get(), "Runs at the same time (default: as many as there are cores)",
              {.lowest = 1});
  verb.flag("--quick", given.get(), "Small boxes and short spans, to see what to expect", {.excludes = {"--full"}});
  verb.flag("--full", given.get(), "The resolution of the paper");
  verb.flag("--retry", given.get(), "Try failed runs again");
  verb.flag("--write-only", given.get(), "Run nothing; report on the runs that are done");
  verb.flag("--quiet", given.get(), "Print the verdicts, warnings and errors only, no progress");
}

}  // namespace mesogen::app
