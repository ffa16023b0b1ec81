#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>

#include "contract_message.hpp"
#include "contract_watch.hpp"
#include "mesogen/diagnostics/error.hpp"
#include "plugin/crash.hpp"

namespace mesogen::testing {

namespace {

using Kind = ContractMessage::Kind;
using Outcome = ContractCheck::Outcome;

Kind kind_of(Outcome outcome) {
  if (outcome == Outcome::held) return Kind::held;
  return outcome == Outcome::broken ? Kind::broken : Kind::note;
}

Outcome outcome_of(Kind kind) {
  if (kind == Kind::held) return Outcome::held;
  return kind == Kind::broken ? Outcome::broken : Outcome::note;
}

struct Pipe {
  Pipe() {
    if (::pipe(ends.data()) != 0)
      throw Error(ExitCode::run_failed, fmt::format("no pipe can be made ({})", std::strerror(errno)));
  }
  ~Pipe() {
    close_writing();
    ::close(ends[0]);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  [[nodiscard]] int reading() const { return ends[0]; }
  [[nodiscard]] int writing() const { return ends[1]; }
  void close_writing() {
    if (ends[1] >= 0) ::close(ends[1]);
    ends[1] = -1;
  }
  std::array<int, 2> ends{};
};

/// Checks until all is done or the plugin ends the process.
[[noreturn]] void check_here(PluginKind kind, std::string_view name, const ContractSettings& settings, unsigned seconds,
                             std::set<std::string> done, int messages, int crash) {
  tell_of_crashes(crash);
  tell_of_crashes_in_threads();
  ContractWatch watch;
  watch.done = std::move(done);
  watch.begun = [&](const std::string& what) {
    ::alarm(seconds);
    send(messages, {Kind::begun, 0, what, {}});
  };
  watch.ended = [&](const ContractCheck& check) {
    send(messages, {kind_of(check.outcome), 0, check.what, check.problem});
  };
  try {
    (void)check_contract(kind, name, settings, watch);
    send(messages, {Kind::complete, 0, {}, {}});
  } catch (const Error& error) {
    send(messages, {Kind::refused, static_cast<int>(error.code()), error.what(), {}});
  } catch (const std::exception& error) {
    send(messages, {Kind::refused, static_cast<int>(ExitCode::run_failed), error.what(), {}});
  }
  std::exit(0);  // what is static in the plugin ends here too
}

/// One child: what it said, and how it ended.
struct Child {
  std::vector<ContractCheck> checks;
  std::optional<Error> refused;
  bool complete = false;
  std::string begun = "it can be loaded";  ///< the check in which it ended
  std::string end;                         ///< how; empty if well
};

std::string end_text(bool complete, int status, std::string crash) {
  constexpr std::string_view prefix = "error: ";
  const auto at = crash.find(prefix);
  if (at != std::string::npos) crash.erase(0, at + prefix.size());
  while (crash.ends_with('\n')) crash.pop_back();
  if (!crash.empty()) return crash;
  if (complete && status == 0) return {};
  if (WIFSIGNALED(status))
    return fmt::format("the process was ended by signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status)));
  return fmt::format("it ended the process, with exit status {}; throw an error instead", WEXITSTATUS(status));
}

Child run_child(PluginKind kind, std::string_view name, const ContractSettings& settings, unsigned seconds,
                const std::set<std::string>& done) {
  Pipe messages;
  Pipe crash;
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child < 0) throw Error(ExitCode::run_failed, fmt::format("no process can be started ({})", std::strerror(errno)));
  if (child == 0) check_here(kind, name, settings, seconds, done, messages.writing(), crash.writing());
  messages.close_writing();
  crash.close_writing();
  Child seen;
  while (const auto message = receive(messages.reading())) {
    switch (message->kind) {
      case Kind::begun: seen.begun = message->what; break;
      case Kind::refused: seen.refused.emplace(static_cast<ExitCode>(message->code), message->what); break;
      case Kind::complete: seen.complete = true; break;
      default: seen.checks.push_back({message->what, outcome_of(message->kind), message->problem});
    }
  }
  const std::string text = receive_text(crash.reading());
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  seen.end = end_text(seen.complete, status, text);
  return seen;
}

}  // namespace

std::vector<ContractCheck> check_contract_apart(PluginKind kind, std::string_view name,
                                                const ContractSettings& settings, unsigned seconds) {
  std::vector<ContractCheck> checks;
  std::set<std::string> done;
  for (;;) {
    const Child child = run_child(kind, name, settings, seconds, done);
    if (child.refused) throw *child.refused;
    for (const ContractCheck& check : child.checks) {
      checks.push_back(check);
      done.insert(check.what);
    }
    if (child.complete) {
      if (!child.end.empty()) checks.push_back({"its process ends well", Outcome::broken, child.end});
      return checks;
    }
    // It ended where the one before did: what this belongs to cannot be left out, so there is nothing to go on with.
    if (!done.insert(child.begun).second) return checks;
    checks.push_back({child.begun, Outcome::broken, child.end});
  }
}

}  // namespace mesogen::testing
