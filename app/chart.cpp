#include <memory>

#include "python.hpp"
#include "verbs.hpp"

namespace mesogen::app {

void add_chart(Verb& command) {
  const auto given = std::make_shared<Forwarded>(with_this_mesogen());
  Verb& verb = command.verb("chart", "Run or continue a study of accuracy or stability, and chart its results",
                            [given] { return hand_over("chart", "mesogen.charts", *given); });
  verb.argument("STUDY", given.get(), "Study file (TOML)");
  verb.option("--output", "DIR", given.get(),
              "Folder for figures of the runs, tables and charts (default: output/charts/<name of the study>)",
              {.letter = 'o'});
  verb.option("--only", "VARIANT", given.get(),
              "Run only this variant, or several separated by commas; may be repeated (default: all)",
              {.repeated = true});
  verb.flag("--list", given.get(), "List the runs as commands, and whether they are done; runs nothing");
  verb.flag("--draw-only", given.get(), "Run nothing; make tables and charts of the runs that are done");
  verb.flag("--quiet", given.get(), "Print the tables, warnings and errors only, no progress");
}

}  // namespace mesogen::app
