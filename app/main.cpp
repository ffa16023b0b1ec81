#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <csignal>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include "case/nearest.hpp"
#include "diagnostics/version.hpp"
#include "plugin/crash.hpp"
#include "verbs.hpp"

namespace {

using mesogen::ExitCode;

int tell(ExitCode code, const std::string& text) {
  // Several errors of a case: one a line, beginning with file:line:column as editors like it. Lines that belong to the
  // one before are indented.
  bool several = false;
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; ++at)
    several = several || (at + 1 < text.size() && text[at + 1] != ' ');
  fmt::print(stderr, "{}{}{}", several ? "errors:\n" : "error: ", text, text.ends_with('\n') ? "" : "\n");
  return static_cast<int>(code);
}

/// No verb, or `plugin`, `field` and `quantity` without theirs: the help of what was given.
ExitCode explain(const CLI::App& command) {
  const auto given = command.get_subcommands();
  fmt::print(stderr, "{}", given.empty() ? command.help() : given.front()->help(command.get_name()));
  return ExitCode::bad_case;
}

/// A word where a verb is expected, which CLI11 calls an argument that was not.
std::string unknown_verb(const CLI::App& command) {
  const CLI::App* group = &command;
  while (!group->get_subcommands().empty()) group = group->get_subcommands().front();
  std::vector<std::string> verbs;
  for (const CLI::App* verb : group->get_subcommands({})) verbs.push_back(verb->get_name());
  const auto words = command.remaining(true);
  if (verbs.empty() || words.empty() || words.front().starts_with('-')) return {};
  const std::string before = group == &command ? "mesogen" : "mesogen " + group->get_name();
  const std::string hint = mesogen::did_you_mean(words.front(), verbs);
  return fmt::format("{} has no verb \"{}\"{}", before, words.front(),
                     hint.empty() ? fmt::format("; there are: {}", fmt::join(verbs, ", ")) : hint);
}

}  // namespace

int main(int count, char** arguments) {
  using namespace mesogen;
  // Beyond a limit on the size of files (ulimit -f) writing is to fail with an error, not to end the process.
  std::signal(SIGXFSZ, SIG_IGN);
  tell_of_crashes(STDERR_FILENO);
  try {
    CLI::App command("Mesogen: active nematics by smoothed particle hydrodynamics", "mesogen");
    command.set_version_flag("--version", fmt::format("mesogen {} ({})", version(), build_text()));
    command.set_help_all_flag("--help-all", "Print the help of all verbs");
    command.require_subcommand(0, 1);
    app::Action action;
    app::add_run(command, action);
    app::add_resume(command, action);
    app::add_branch(command, action);
    app::add_replay(command, action);
    app::add_check(command, action);
    app::add_graph(command, action);
    app::add_plugin(command, action);
    app::add_field(command, action);
    app::add_quantity(command, action);
    app::add_schema(command, action);
    app::add_reference(command, action);
    app::add_report(command, action);
    app::add_chart(command, action);
    app::add_sweep(command, action);
    app::add_study(command, action);
    try {
      command.parse(count, arguments);
    } catch (const CLI::ParseError& error) {
      if (const std::string text = unknown_verb(command);
          !text.empty() && error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError))
        return tell(ExitCode::bad_case, text);
      const int result = command.exit(error, std::cout, std::cerr);
      return static_cast<int>(result == 0 ? ExitCode::done : ExitCode::bad_case);
    }
    return static_cast<int>(action ? action() : explain(command));
  } catch (const Error& error) {
    return tell(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return tell(ExitCode::run_failed, "there is not enough memory; take fewer particles, or single precision");
  } catch (const std::exception& error) {
    return tell(ExitCode::run_failed, fmt::format("unexpected: {}", error.what()));
  } catch (...) {
    return tell(ExitCode::run_failed, "unexpected: something that is no std::exception was thrown");
  }
}
