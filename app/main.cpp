#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "command_line/parse.hpp"
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

}  // namespace

int main(int count, char** arguments) {
  using namespace mesogen;
  // Beyond a limit on the size of files (ulimit -f) writing is to fail with an error, not to end the process.
  std::signal(SIGXFSZ, SIG_IGN);
  tell_of_crashes(STDERR_FILENO);
  try {
    app::Verb command("mesogen", "Mesogen: active nematics by smoothed particle hydrodynamics");
    bool version_wanted = false;
    command.flag("--version", &version_wanted, "Print the version and how it was built");
    for (const auto add : {app::add_run, app::add_resume, app::add_branch, app::add_replay, app::add_check,
                           app::add_graph, app::add_plugin, app::add_field, app::add_quantity, app::add_schema,
                           app::add_reference, app::add_report, app::add_chart, app::add_sweep, app::add_study})
      add(command);
    const app::Action action = app::parse(command, std::vector<std::string>(arguments + 1, arguments + count));
    if (version_wanted) return fmt::print("mesogen {} ({})\n", version(), build_text()), 0;
    return static_cast<int>(action());
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
