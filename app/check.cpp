#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "check_facts.hpp"
#include "diagnostics/resources.hpp"
#include "options.hpp"
#include "room.hpp"
#include "verbs.hpp"

namespace mesogen::app {

namespace {

struct Options {
  CaseOptions source;
  RunningOptions running;
  bool quick = false;
  bool json = false;
};

const char* verdict(const CheckFacts& facts) {
  if (!facts.problems.empty()) return " cannot be run here";
  if (time_stands_still(facts.steps)) return " is right, but its run would never end";
  return facts.breaks_down ? " is right, but its run breaks down" : " can be run";
}

ExitCode check(const Options& options) {
  use_threads(options.running);
  const auto registry = load_plugins(options.source.plugin_folders);
  const auto program = static_cast<double>(resident_memory());
  const SetUpWith set_up_with = with_settings(options.source, registry);
  refuse_far_beyond_memory(read(options.source, registry), program, set_up_with);
  const auto setup = set_up_with({});
  const CheckFacts facts = check_facts(*setup, !options.quick, program, set_up_with);
  for (const std::string& text : facts.warnings) fmt::print(stderr, "warning: {}\n", text);
  if (options.json) {
    fmt::print("{}", check_json(*setup, registry, facts));
  } else {
    fmt::print("{}{}\n", check_text(*setup, registry, facts), options.source.file + verdict(facts));
  }
  std::fflush(stdout);
  facts.problems.throw_if_any();
  return ExitCode::done;
}

}  // namespace

void add_check(Verb& command) {
  const auto options = std::make_shared<Options>();
  Verb& verb = command.verb("check", "Check a case and predict time, memory and disk of its run; writes nothing",
                            [options] { return check(*options); });
  add_case(verb, options->source);
  add_threads(verb, options->running.threads);
  verb.flag("--quick", &options->quick, "Take no steps; the wall time is then not predicted");
  verb.flag("--json", &options->json, "Print JSON, for programs");
}

}  // namespace mesogen::app
