#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <exception>
#include <new>
#include <string>
#include <thread>
#include <vector>

#include "command_line/parse.hpp"
#include "diagnostics/version.hpp"
#include "plugin/crash.hpp"
#include "ranks/mpi_library.hpp"
#include "verbs.hpp"

namespace {

using mesogen::ExitCode;

/// The ranks that run with this one; where there should be others and MPI is not there, itself.
const mesogen::Ranks& ranks_now() {
  try {
    return mesogen::ranks_of_process();
  } catch (const mesogen::Error&) {
    return mesogen::Ranks::alone();
  }
}

// Of several ranks mostly all meet the same error: the first one tells it, and ends them. Where another one is alone
// with its error, it is still there some seconds later.
int tell(ExitCode code, const std::string& text) {
  const mesogen::Ranks& ranks = ranks_now();
  if (!ranks.is_first()) std::this_thread::sleep_for(std::chrono::seconds(5));
  const std::string who = ranks.is_first() ? "" : fmt::format("rank {}: ", ranks.rank());
  // Several errors of a case: one a line, beginning with file:line:column as editors like it. Lines that belong to the
  // one before are indented.
  bool several = false;
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; ++at)
    several = several || (at + 1 < text.size() && text[at + 1] != ' ');
  fmt::print(stderr, "{}{}{}{}", several ? "errors:\n" : "error: ", who, text, text.ends_with('\n') ? "" : "\n");
  if (ranks.several()) ranks.abort(static_cast<int>(code));
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
