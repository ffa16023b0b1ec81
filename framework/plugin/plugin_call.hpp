#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/export.hpp"

namespace mesogen {

/// One call into a plugin: who is called, and what for. While a case is put together: `plugin "wcsph", declare()`;
/// while it runs: `physics.flow (plugin "wcsph"), pass "continuity" at step 3, t = 0.02 s`.
struct PluginCall {
  std::string_view plugin;             ///< its name, or its file while it is loaded
  std::string_view call;               ///< "sample()", "pass"
  std::string_view subject = {};       ///< the name of a pass
  std::string_view section = {};       ///< while a case runs, "physics." or "observers."; empty if `instance` has it
  std::string_view instance = {};      ///< while a case runs, "flow"
  const std::int64_t* step = nullptr;  ///< while a case runs; read when the text is made
  const double* time = nullptr;        ///< likewise
  std::string_view time_unit = "s";    ///< of the case
};

/// That text.
MESOGEN_EXPORT std::string call_text(const PluginCall& call);

/// Exists while a call into a plugin is under way, so that a crash can be told with its name: see plugin/crash.hpp. The
/// calls of a thread are a list on its stack, the innermost first.
class CallUnderWay {
 public:
  explicit CallUnderWay(const PluginCall& made) : call(made), outer(innermost) { innermost = this; }
  ~CallUnderWay() { innermost = outer; }
  CallUnderWay(const CallUnderWay&) = delete;
  CallUnderWay& operator=(const CallUnderWay&) = delete;

  const PluginCall& call;
  const CallUnderWay* const outer;

  /// Of this thread. Reading it calls no function, so a signal handler may.
  MESOGEN_EXPORT static constinit thread_local const CallUnderWay* innermost __attribute__((tls_model("initial-exec")));
};

/// Throws on what a plugin threw, as an Error that begins with the text of the call. An Error keeps its exit code, for
/// it is meant for the user; anything else gets `code`. To be called in catch (...).
[[noreturn]] MESOGEN_EXPORT void rethrow_of_plugin(const PluginCall& call, ExitCode code);

/// Makes a call into a plugin. Whatever it throws comes out as an Error that names the plugin and the call.
template <class Action>
auto call_plugin(const PluginCall& call, ExitCode code, Action&& action) -> decltype(action()) {
  const CallUnderWay under_way(call);
  try {
    return std::forward<Action>(action)();
  } catch (...) {
    rethrow_of_plugin(call, code);
  }
}

/// The same while a case is put together.
template <class Action>
auto call_plugin(std::string_view plugin, std::string_view call, Action&& action) -> decltype(action()) {
  return call_plugin(PluginCall{.plugin = plugin, .call = call}, ExitCode::plugin_refused,
                     std::forward<Action>(action));
}

}  // namespace mesogen
